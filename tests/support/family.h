#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "tests/support/chi_squared.h"

/// One alpha for all that a test compares.
namespace interflect::test {

/// The largest |z| that `comparisons` two-sided normal tests may show under one family alpha (Sidak): each has
/// 1 - (1 - alpha)^(1/M).
inline double critical_z(double alpha, std::size_t comparisons) {
  const double each = -std::expm1(std::log1p(-alpha) / static_cast<double>(comparisons));
  double low = 0, high = 40;
  for (int i = 0; i < 100; ++i) (std::erfc((low + high) / 2 / std::sqrt(2.0)) > each ? low : high) = (low + high) / 2;
  return low;
}

/// Family alpha of a statistical test that states no other, as those of coverage do: 181 .. 197 of 200 intervals are
/// missed by chance in .04 to .06.  Seeds are fixed, so that a test either always passes or never.
inline constexpr double alpha = 1e-3;

/// An alpha that a number of tails share alike, whether they depend on each other or not (Bonferroni): a number that may
/// be too large or too small has two tails, chi-squared one.  The number is told beforehand, and a test that then asks
/// for another one fails: alpha is divided among as many as there are.
class Family {
 public:
  explicit Family(std::size_t tails, double of = alpha) : tails_(tails), level_(of / static_cast<double>(tails)) {}
  Family(const Family&) = delete;
  Family& operator=(const Family&) = delete;
  ~Family() { EXPECT_EQ(asked_, tails_) << "tails were asked for, and alpha was divided among the second number"; }

  /// Of each of so many more.
  double level(std::size_t tails = 1) {
    asked_ += tails;
    return level_;
  }
  /// The largest |z| of one more normal number.
  double z() { return normal_quantile(level(2)); }

 private:
  std::size_t tails_, asked_ = 0;
  double level_;
};

/// Those of `expect_as_expected`: chi-squared, and how many there are in all.
inline constexpr std::size_t tails_of_counts = 3;
inline void expect_as_expected(const std::vector<double>& counts, const std::vector<double>& expected, Family& family,
                               const std::string& name) {
  expect_as_expected(counts, expected, family.level(tails_of_counts), name);
}

}  // namespace interflect::test

#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

/// Counts against what they are expected to be.
namespace interflect::test {

/// z above which a standard normal number is with this probability.
inline double normal_quantile(double level) {
  double low = 0, high = 40;
  for (int i = 0; i < 100; ++i)
    (std::erfc((low + high) / 2 / std::sqrt(2.0)) / 2 > level ? low : high) = (low + high) / 2;
  return low;
}

/// Upper quantile of chi-squared by Wilson and Hilferty's cube; to about 1 % for 15 cells or more.
inline double chi_squared_limit(double degrees, double level) {
  const double a = 2 / (9 * degrees);
  return degrees * std::pow(1 - a + normal_quantile(level) * std::sqrt(a), 3);
}

/// Independent counts of cells, of which few are expected to be in any one, beside those in none: chi-squared over cells
/// of at least ten, smaller ones together, and by itself how many there are in all.
/// @param level  alpha of each of the two
inline void expect_as_expected(const std::vector<double>& counts, const std::vector<double>& expected, double level,
                               const std::string& name) {
  double sum = 0, cells = 0, few = 0, few_expected = 0, all = 0, all_expected = 0;
  const auto add = [&](double count, double of) {
    sum += (count - of) * (count - of) / of;
    ++cells;
  };
  for (std::size_t k = 0; k < counts.size(); ++k) {
    all += counts[k], all_expected += expected[k];
    few += counts[k], few_expected += expected[k];
    if (few_expected < 10) continue;
    add(few, few_expected);
    few = few_expected = 0;
  }
  if (few_expected > 0) sum += few * few / (few_expected + 10);  // what is left is too little to tell by itself
  if (cells > 1) {
    EXPECT_LT(sum, chi_squared_limit(cells, level)) << name << ": " << cells << " cells";
  }
  EXPECT_NEAR(all, all_expected, normal_quantile(level) * std::sqrt(all_expected) + 1e-4 * all_expected) << name;
}

}  // namespace interflect::test

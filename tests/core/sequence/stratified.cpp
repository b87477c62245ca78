#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/sample_sequence.h"
#include "core/sequence/strata.h"
#include "tests/core/sequence/statistics.h"

namespace interflect::core {
namespace {

constexpr std::uint64_t n = strata;
constexpr std::uint64_t blocks[]{0, 3, std::uint64_t{1} << 40};

TEST(LatinHypercube, has_one_in_each_stratum_of_each_dimension) {
  const auto sequence = make_sequence("latin-hypercube", 5);
  for (const std::uint64_t block : blocks) {
    std::vector<int> found[3];
    for (auto& of : found) of.assign(n, 0);
    for (std::uint64_t k = 0; k < n; ++k) {
      double u[3];
      sequence->point(n * block + k, u);
      for (std::size_t d = 0; d < 3; ++d) ++found[d][test::interval_of(u[d], n)];
    }
    for (const auto& of : found) EXPECT_EQ(std::count(of.begin(), of.end(), 1), std::ptrdiff_t(n));
  }
}

TEST(StratifiedSequence, has_one_in_each_square_of_each_pair_of_dimensions) {
  const auto sequence = make_sequence("stratified", 5);
  for (const std::uint64_t block : blocks) {
    std::vector<int> found[3];
    for (auto& of : found) of.assign(n, 0);
    for (std::uint64_t k = 0; k < n; ++k) {
      double u[6];
      sequence->point(n * block + k, u);
      for (std::size_t pair = 0; pair < 3; ++pair)
        ++found[pair][64 * test::interval_of(u[2 * pair], 64) + test::interval_of(u[2 * pair + 1], 64)];
    }
    for (const auto& of : found) EXPECT_EQ(std::count(of.begin(), of.end(), 1), std::ptrdiff_t(n));
  }
}

TEST(Strata, the_last_one_ends_below_one) {
  constexpr double last = 0x1.fffffffffffffp-1;
  EXPECT_LT(in_stratum(4095, 4096, last), 1);
  EXPECT_LT(in_stratum(63, 64, last), 1);
  EXPECT_EQ(in_stratum(1, 4, .5), .375);
}

constexpr int repetitions = 1000;

/// The mean square of the mean of f, whose integral is 0, over the first 4 096 points.
double variance(const std::string& name, std::size_t dimensions, const std::function<double(const double*)>& f) {
  const auto sequence = make_sequence(name, 7);
  std::vector<double> u(n * dimensions);
  double squares = 0;
  for (std::uint64_t r = 0; r < repetitions; ++r) {
    sequence->replicate(r)->points(0, dimensions, u);
    double sum = 0;
    for (std::size_t k = 0; k < n; ++k) sum += f(&u[k * dimensions]);
    squares += std::pow(sum / n, 2);
  }
  return squares / repetitions;
}

// Within 5 standard deviations of what 1 000 squares of normal numbers say of their variance: 22 %.
void expect_variance(double found, double exact, const char* what) {
  EXPECT_LT(std::abs(test::off_by(repetitions * found / exact, repetitions)), 5) << what << ' ' << found / exact;
}

TEST(StratifiedSequence, variances_of_sums_and_products_are_the_exact_ones) {
  const auto sum = [](const double* u) { return u[0] + u[1] - 1; };
  const auto product = [](const double* u) { return (u[0] - .5) * (u[1] - .5); };
  const double v = 1. / 12 / n;
  expect_variance(variance("independent", 2, sum), 2. / 12 / n, "random sum");
  expect_variance(variance("latin-hypercube", 2, sum), 2. / 12 / n / n / n, "Latin sum");
  expect_variance(variance("stratified", 2, sum), 1. / 6 / n / n, "jittered sum");
  expect_variance(variance("latin-hypercube", 2, product), 1. / 144 / n, "Latin product");
  expect_variance(variance("stratified", 2, product), (v / 6 - v * v) / n, "jittered product");
}

// Of a product across pairs strata say nothing, of a sum they do.
TEST(StratifiedSequence, pairs_know_nothing_of_each_other) {
  expect_variance(variance("stratified", 4, [](const double* u) { return (u[1] - .5) * (u[2] - .5); }), 1. / 144 / n,
                  "product of two pairs");
  expect_variance(variance("stratified", 4, [](const double* u) { return u[0] + u[1] + u[2] + u[3] - 2; }),
                  2. / 6 / n / n, "sum of two pairs");
}

// Cells of two dimensions, of which each has its share of each block: by 16 blocks of 4 096 points 15² degrees of
// freedom, where orders of strata are independent.  Two-sided, alpha 1e-6 over all.
TEST(StratifiedSequence, orders_of_strata_are_independent) {
  for (const std::string name : {"stratified", "latin-hypercube"}) {
    const auto sequence = make_sequence(name, 11);
    constexpr std::size_t dimensions = 8;
    std::vector<double> u(16 * n * dimensions);
    sequence->points(0, dimensions, u);
    for (std::size_t a = 0; a < dimensions; ++a)
      for (std::size_t b = a + 1; b < dimensions; ++b) {
        if (name == "stratified" && a / 2 == b / 2) continue;
        test::Cells cells(256);
        for (std::size_t k = 0; k < 16 * n; ++k)
          cells.add(16 * test::interval_of(u[k * dimensions + a], 16) + test::interval_of(u[k * dimensions + b], 16));
        EXPECT_LT(cells.chi_squared(), test::chi_squared_limit(225, 1e-6 / 104)) << name << ' ' << a << ' ' << b;
        EXPECT_GT(cells.chi_squared(), test::chi_squared_limit(225, 1 - 1e-6 / 104)) << name << ' ' << a << ' ' << b;
      }
  }
}

// Parts of a block are as independent points: 64 points, the variance of sums within 5 standard deviations, less the
// share (64 - 1) / (4 096 - 1) that strata which are not met twice take away.
TEST(StratifiedSequence, parts_of_blocks_are_as_independent_points) {
  for (const char* name : {"stratified", "latin-hypercube"}) {
    const auto sequence = make_sequence(name, 12);
    double squares = 0;
    for (std::uint64_t r = 0; r < repetitions; ++r) {
      double u[128], sum = 0;
      sequence->replicate(r)->points(64 * (r % 64), 2, u);
      for (const double number : u) sum += number - .5;
      squares += std::pow(sum / 64, 2);
    }
    expect_variance(squares / repetitions, 2. / 12 / 64 * (1 - 63. / 4095), name);
  }
}

}  // namespace
}  // namespace interflect::core

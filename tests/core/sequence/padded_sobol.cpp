#include "core/sequence/padded_sobol.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/moments.h"
#include "tests/core/sequence/statistics.h"

namespace interflect::core {
namespace {

struct Kind {
  const char* name;
  std::size_t size;  ///< of a group
};
class PaddedSobolSequence : public testing::TestWithParam<Kind> {
 protected:
  std::unique_ptr<SampleSequence> make(std::uint64_t seed) const { return make_sequence(GetParam().name, seed); }
  std::size_t size() const { return GetParam().size; }
};

constexpr std::uint64_t two_to_32 = std::uint64_t{1} << 32;

// Of aligned blocks of 2^m points, in three groups: one in each interval of 2^-m of each dimension, and of a group's
// first two dimensions one in each rectangle 2^-a x 2^-(m-a).
TEST_P(PaddedSobolSequence, blocks_have_one_in_each_elementary_interval_and_rectangle) {
  for (const std::uint64_t seed : {1u, 2u}) {
    const auto sequence = make(seed);
    const std::size_t dimensions = 3 * size();
    for (unsigned m = 0; m <= 12; ++m) {
      const std::uint64_t n = std::uint64_t{1} << m;
      for (const std::uint64_t first : {std::uint64_t{0}, n, 5 * n, two_to_32 - n, two_to_32 + 3 * n}) {
        std::vector<double> u(n * dimensions);
        sequence->points(first, dimensions, u);
        const auto filled = [&](std::size_t x, std::size_t y, unsigned a) {
          std::vector<bool> met(n);
          for (std::size_t k = 0; k < n; ++k)
            met[test::interval_of(u[k * dimensions + x], std::size_t{1} << a) << (m - a) |
                test::interval_of(u[k * dimensions + y], std::size_t{1} << (m - a))] = true;
          return std::count(met.begin(), met.end(), true) == std::ptrdiff_t(n);
        };
        for (std::size_t d = 0; d < dimensions; ++d) ASSERT_TRUE(filled(d, d, m)) << m << ' ' << first << ' ' << d;
        for (std::size_t d = 0; d < dimensions; d += size())
          for (unsigned a = 0; a <= m; ++a)
            ASSERT_TRUE(filled(d, d + 1, a)) << m << ' ' << first << ' ' << d << ' ' << a;
      }
    }
  }
}

// The mean of x_1 + .. + x_d over n = 2^m points has the variance d / (12 n³), groups or not.  5 standard deviations
// of the variance of 1 000 means.
TEST_P(PaddedSobolSequence, sums_have_the_variance_of_strata) {
  constexpr int repetitions = 1000;
  constexpr std::size_t n = 256, dimensions = 10;
  const auto sequence = make(3);
  std::vector<double> u(n * dimensions);
  double squares = 0;
  for (std::uint64_t r = 0; r < repetitions; ++r) {
    sequence->replicate(r)->points(n * (r % 3), dimensions, u);
    double sum = 0;
    for (const double number : u) sum += number - .5;
    squares += std::pow(sum / n, 2) * 12 * std::pow(double(n), 3) / dimensions;
  }
  EXPECT_LT(std::abs(test::off_by(squares, repetitions)), 5) << squares / repetitions;
}

// exp(x + y) as with an exactly scrambled net (tests/core/sequence/owen.cpp), in each group, shuffled: root mean squares
// of 200 means, off by 5 %; slope -1.43.  Reference: methods_montecarlo_core.md, section 3.6.
TEST_P(PaddedSobolSequence, groups_have_the_errors_of_nested_scrambling) {
  constexpr int repetitions = 200;
  const std::size_t dimensions = 2 * size();
  std::vector<double> u(4096 * dimensions);
  double squares[2][13] = {};
  const auto sequence = make(4);
  for (std::uint64_t r = 0; r < repetitions; ++r) {
    sequence->replicate(r)->points(0, dimensions, u);
    for (std::size_t group = 0; group < 2; ++group) {
      double sum = 0;
      for (std::size_t k = 0; k < 4096; ++k) {
        const double* const x = &u[k * dimensions + group * size()];
        sum += std::exp(x[0] + x[1]);
        for (int m = 7; m <= 12; ++m)
          if (k + 1 == std::size_t{1} << m)
            squares[group][m] += std::pow(sum / double(k + 1) - std::pow(std::exp(1.) - 1, 2), 2);
      }
    }
  }
  for (const auto& of : squares) {
    std::vector<double> x, y;
    for (int m = 7; m <= 12; ++m) x.push_back(m), y.push_back(.5 * std::log2(of[m] / repetitions));
    EXPECT_NEAR(test::slope(x, y), -1.43, .1);
    EXPECT_NEAR(std::exp2(y[1]) / 5.46e-4, 1, .3);
    EXPECT_NEAR(std::exp2(y[5]) / 9.60e-6, 1, .3);
  }
}

// Products (x - 1/2)(y - 1/2) across groups are 0 in the mean, with 49/31 of independent points' variance 1 / (144 n):
// points k and k' whose highest different bit is p have, each group by its own shuffle, a covariance of -8^-p / 16, and
//   144 sum_p 2^p (8^-p / 16)² = (9 / 16) (32 / 31).
// Alpha 1e-6 for the means; 5 standard deviations of the variance of 1 000 of them.
TEST_P(PaddedSobolSequence, groups_know_nothing_of_each_other) {
  constexpr std::size_t n = 1024;
  const std::size_t dimensions = 3 * size();
  const auto sequence = make(5);
  std::vector<double> u(n * dimensions);
  const std::pair<std::size_t, std::size_t> pairs[]{{0, size()},          {0, 2 * size()},
                                                    {1, size()},          {size() - 1, dimensions - 1},
                                                    {size(), 2 * size()}, {size() + 1, 2 * size() + 1}};
  ScalarMoments products[6];
  double squares[6] = {};
  constexpr int repetitions = 1000;
  for (std::uint64_t r = 0; r < repetitions; ++r) {
    sequence->replicate(r)->points(0, dimensions, u);
    for (std::size_t i = 0; i < 6; ++i) {
      double sum = 0;
      for (std::size_t k = 0; k < n; ++k)
        sum += (u[k * dimensions + pairs[i].first] - .5) * (u[k * dimensions + pairs[i].second] - .5);
      products[i].add(sum / n);
      squares[i] += std::pow(sum / n, 2) * 144 * n;
    }
  }
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_LT(std::abs(products[i].mean()), test::upper_z(1e-6 / 24) * products[i].standard_error()) << i;
    EXPECT_LT(std::abs(test::off_by(squares[i] * 31 / 49, repetitions)), 5) << i << ' ' << squares[i];
  }
}

// Points 2 j and 2 j + 1 differ in the first bit of every word, and nowhere else, before they are scrambled.  After
// that their first bits differ, and their second ones are four coins, in two dimensions that have coins of their own: over
// replications 64 cells, of the first two bits of one point and the second ones of the other.  Where dimensions share
// coins, which no single point tells, since shuffles alone make it uniform, two of these say the others' sum.
// Alpha 1e-6 over all pairs of dimensions.
TEST_P(PaddedSobolSequence, dimensions_have_scrambles_of_their_own) {
  constexpr std::size_t dimensions = 10, pairs = dimensions * (dimensions - 1) / 2;
  std::vector<test::Cells> cells(pairs, test::Cells(64));
  const auto sequence = make(8);
  for (std::uint64_t r = 0; r < 1 << 13; ++r) {
    double u[2 * dimensions];
    sequence->replicate(r)->points(2 * (r % 7), dimensions, u);
    std::size_t x[dimensions], y[dimensions], pair = 0;
    for (std::size_t d = 0; d < dimensions; ++d) {
      x[d] = test::interval_of(u[d], 4), y[d] = test::interval_of(u[dimensions + d], 4);
      ASSERT_NE(x[d] / 2, y[d] / 2);
    }
    for (std::size_t a = 0; a < dimensions; ++a)
      for (std::size_t b = 0; b < a; ++b) cells[pair++].add(x[a] << 4 | x[b] << 2 | (y[a] & 1) << 1 | (y[b] & 1));
  }
  for (std::size_t pair = 0; pair < pairs; ++pair)
    EXPECT_TRUE(cells[pair].uniform(1e-6 / pairs)) << pair << ' ' << cells[pair].chi_squared();
}

// Beyond the 32 bits of a scrambled word numbers are uniform too, and of points that follow each other independent.
TEST_P(PaddedSobolSequence, bits_after_the_words_are_uniform) {
  const auto sequence = make(6);
  test::Cells bits(256);
  std::size_t before = 0;
  for (std::uint64_t k = 0; k < 1 << 16; ++k) {
    double u[7];
    sequence->point(k, u);
    const double words = u[6] * 0x1p32;
    const std::size_t now = test::interval_of(words - std::floor(words), 16);
    if (k % 2 == 1) bits.add(16 * before + now);
    before = now;
  }
  EXPECT_TRUE(bits.uniform(1e-6)) << bits.chi_squared();
}

TEST_P(PaddedSobolSequence, starts_anew_after_two_to_the_32_points) {
  const auto sequence = make(7);
  test::Cells joint(256);
  for (std::uint64_t k = 0; k < 1 << 14; ++k) {
    double u, v;
    sequence->numbers(k * 0x10001, 5, {&u, 1});
    sequence->numbers(k * 0x10001 + two_to_32 * (k % 7 + 1), 5, {&v, 1});
    joint.add(16 * test::interval_of(u, 16) + test::interval_of(v, 16));
  }
  EXPECT_TRUE(joint.uniform(1e-6)) << joint.chi_squared();
}

TEST(PaddedSobol, is_a_seed_and_no_more) {
  EXPECT_LE(sizeof(SobolOwen), sizeof(void*) + sizeof(std::uint64_t));
  EXPECT_LE(sizeof(ZeroTwo), sizeof(void*) + sizeof(std::uint64_t));
}

INSTANTIATE_TEST_SUITE_P(Both, PaddedSobolSequence, testing::Values(Kind{"sobol-owen", 4}, Kind{"zero-two", 2}),
                         [](const auto& each) { return each.param.size == 4 ? "sobol_owen" : "zero_two"; });

}  // namespace
}  // namespace interflect::core

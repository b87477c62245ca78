#include "core/sequence/halton.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/moments.h"
#include "core/random.h"
#include "tests/core/sequence/statistics.h"

namespace interflect::core {
namespace {

constexpr std::uint64_t largest = ~std::uint64_t{0};

/// Of D digits, as radical inverses have.
std::uint64_t power_of(std::uint64_t base) {
  std::uint64_t power = 1;
  while (power < std::uint64_t{1} << 32) power *= base;
  return power;
}

std::uint64_t key_of_seed(std::uint64_t seed, std::uint32_t stream) {
  const RandomBlock words = random_block(seed, stream, 5, 6);
  return std::uint64_t{words[0]} << 32 | words[1];
}

TEST(RadicalInverse, mirrors_digits) {
  EXPECT_EQ(radical_inverse(2, 0), 0);
  EXPECT_EQ(radical_inverse(2, 6), .375);
  EXPECT_DOUBLE_EQ(radical_inverse(3, 5), 7. / 9);  // 12 -> .21
  EXPECT_DOUBLE_EQ(radical_inverse(10, 1234), .4321);
  for (const std::uint32_t base : {2u, 3u, 47u, 311u}) {
    const double last = 1 - 1 / static_cast<double>(power_of(base));
    EXPECT_EQ(radical_inverse(base, power_of(base) - 1), last);
    EXPECT_LT(radical_inverse(base, largest), 1);
  }
}

TEST(Halton, has_the_first_64_primes_for_bases) {
  EXPECT_EQ(HaltonSequence::base(0), 2u);
  EXPECT_EQ(HaltonSequence::base(14), 47u);
  EXPECT_EQ(HaltonSequence::base(15), 53u);
  EXPECT_EQ(HaltonSequence::base(63), 311u);
  EXPECT_THROW(HaltonSequence::base(64), std::out_of_range);
}

double correlation_of_64(const std::function<double(std::uint64_t)>& x, const std::function<double(std::uint64_t)>& y) {
  double mx = 0, my = 0, xx = 0, yy = 0, xy = 0;
  for (std::uint64_t k = 0; k < 64; ++k) mx += x(k) / 64, my += y(k) / 64;
  for (std::uint64_t k = 0; k < 64; ++k)
    xx += std::pow(x(k) - mx, 2), yy += std::pow(y(k) - my, 2), xy += (x(k) - mx) * (y(k) - my);
  return xy / std::sqrt(xx * yy);
}

TEST(RadicalInverse, correlations_of_the_first_64_points_are_the_known_ones) {
  const auto of = [](std::uint32_t a, std::uint32_t b) {
    return correlation_of_64([=](std::uint64_t k) { return radical_inverse(a, k); },
                             [=](std::uint64_t k) { return radical_inverse(b, k); });
  };
  EXPECT_NEAR(of(2, 3), -.021538, 5e-7);
  EXPECT_NEAR(of(17, 19), .130831, 5e-7);
  EXPECT_NEAR(of(47, 53), .552591, 5e-7);
}

// Of 47 and 53, over 200 seeds: their mean is 0, and they are about those of 64 independent pairs, 1/8.  Alpha 1e-6 for
// the mean; the root of the mean of squares is off by 5 %.
TEST(Halton, scrambled_digits_have_no_correlations) {
  ScalarMoments correlations;
  double squares = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const HaltonSequence sequence(seed);
    const auto number = [&](std::size_t d) {
      return [&sequence, d](std::uint64_t k) {
        double u;
        sequence.numbers(k, d, {&u, 1});
        return u;
      };
    };
    const double found = correlation_of_64(number(14), number(15));
    if (seed < 3) {
      EXPECT_LT(std::abs(found), .3);
    }
    correlations.add(found);
    squares += found * found / 200;
  }
  EXPECT_LT(std::abs(correlations.mean()), 5 * correlations.standard_error());
  EXPECT_LT(std::sqrt(squares), .125 * 1.25);
}

// Of b^m numbers that follow each other from a multiple of b^m one is in each interval of length b^-m.
TEST(Halton, scrambled_numbers_have_one_in_each_elementary_interval) {
  const HaltonSequence sequence(5);
  for (std::size_t d = 0; d < HaltonSequence::dimensions; ++d) {
    const std::uint64_t b = HaltonSequence::base(d);
    for (std::uint64_t n = b; n <= 5000; n *= b)
      for (const std::uint64_t block : {std::uint64_t{0}, std::uint64_t{1}, 3 * b, power_of(b) / n - 1}) {
        std::vector<int> found(n);
        for (std::uint64_t k = 0; k < n; ++k) {
          double u;
          sequence.numbers(block * n + k, d, {&u, 1});
          ++found[test::interval_of(u, n)];
        }
        ASSERT_EQ(std::count(found.begin(), found.end(), 1), std::ptrdiff_t(n)) << b << ' ' << n << ' ' << block;
      }
  }
}

// Of numbers that have r digits in common: the next ones are any two different ones, and those after them any.
// Alpha 1e-6 over all.
TEST(Halton, scrambles_digits_as_permutations_that_are_independent_in_pairs) {
  for (const std::uint32_t b : {2u, 3u, 5u, 7u})
    for (int r = 0; r < 4; ++r) {
      std::uint64_t common = 1;  // 1 + b + b² + .. : digits 1
      for (int i = 1; i < r; ++i) common = b * common + 1;
      const auto next = static_cast<std::uint64_t>(std::pow(b, r));
      if (r == 0) common = 0;
      const std::uint64_t k = common, l = common + next * (b - 1 + (r % 2 ? b : 0));
      test::Cells cells(std::size_t{b} * (b - 1) * b * b);
      for (std::uint64_t seed = 0; seed < 1 << 15; ++seed) {
        const std::uint64_t key = key_of_seed(seed, 1);
        const auto digits = [&](std::uint64_t of) {
          const double u = scrambled_radical_inverse(b, of, key);
          const std::size_t all = test::interval_of(u, next * b * b);
          return std::pair{all / b % b, all % b};
        };
        const auto [x, after_x] = digits(k);
        const auto [y, after_y] = digits(l);
        ASSERT_NE(x, y);
        cells.add(((x * (b - 1) + (y > x ? y - 1 : y)) * b + after_x) * b + after_y);
      }
      EXPECT_TRUE(cells.uniform(1e-6 / 16)) << b << ' ' << r << ' ' << cells.chi_squared();
    }
}

// The mean of n = b^m numbers has the variance 1 / (12 n³).  5 standard deviations of the variance of 1 000 means.
TEST(Halton, means_of_whole_powers_have_the_variance_of_strata) {
  constexpr int seeds = 1000;
  const std::pair<std::uint32_t, std::uint64_t> powers[]{{2, 256}, {3, 243}, {7, 49}, {47, 47}};
  for (const auto& [base, n] : powers) {
    double squares = 0;
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
      double sum = 0;
      for (std::uint64_t k = 0; k < n; ++k) sum += scrambled_radical_inverse(base, k, key_of_seed(seed, base)) - .5;
      squares += std::pow(sum / double(n), 2) * 12 * std::pow(double(n), 3);
    }
    EXPECT_LT(std::abs(test::off_by(squares, seeds)), 5) << base << ' ' << squares / seeds;
  }
}

// What comes after the digits is uniform, and another one for each number: of k, k + 1 and k + 2^32, which has the
// digits of k.  Alpha 1e-6 over both.
TEST(Halton, numbers_are_uniform_after_their_last_digits) {
  test::Cells next(256), same_digits(256);
  for (std::uint64_t k = 0; k < 1 << 15; ++k) {
    const auto after = [&](std::uint64_t of) {
      const double words = 0x1p32 * scrambled_radical_inverse(2, of, 77);
      return test::interval_of(words - std::floor(words), 16);
    };
    next.add(16 * after(2 * k) + after(2 * k + 1));
    same_digits.add(16 * after(k) + after(k + power_of(2)));
  }
  EXPECT_TRUE(next.uniform(5e-7)) << next.chi_squared();
  EXPECT_TRUE(same_digits.uniform(5e-7)) << same_digits.chi_squared();
}

TEST(Halton, numbers_stay_below_one) {
  for (std::size_t d = 0; d < HaltonSequence::dimensions; ++d) {
    const std::uint32_t b = HaltonSequence::base(d);
    for (std::uint64_t key = 0; key < 3000; ++key)
      for (const std::uint64_t k : {std::uint64_t{0}, power_of(b) - 1, largest}) {
        const double u = scrambled_radical_inverse(b, k, key_of_seed(key, 3));
        ASSERT_GE(u, 0);
        ASSERT_LT(u, 1);
      }
  }
}

}  // namespace
}  // namespace interflect::core

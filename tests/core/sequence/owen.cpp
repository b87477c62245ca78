#include "core/sequence/owen.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>

#include "core/moments.h"
#include "core/random.h"
#include "core/sobol.h"
#include "tests/core/sequence/statistics.h"

namespace interflect::core {
namespace {

using Scramble = std::uint32_t (*)(std::uint32_t word, std::uint64_t seed, std::uint32_t dimension);

std::uint32_t fast(std::uint32_t word, std::uint64_t seed, std::uint32_t dimension) {
  const RandomBlock key = random_block(seed, dimension, 0, 0);
  return owen_scrambled(word, {key[0], key[1]});
}
std::uint32_t shifted(std::uint32_t word, std::uint64_t seed, std::uint32_t dimension) {
  return word ^ random_block(seed, dimension, 0, 0)[0];
}
/// The same kind of hash with the constants published first, [Laine, Karras 2011].
std::uint32_t with_first_constants(std::uint32_t word, std::uint64_t seed, std::uint32_t dimension) {
  std::uint32_t x = reversed_bits(word) + random_block(seed, dimension, 0, 0)[0];
  for (const std::uint32_t even : {0x6C50B47Cu, 0xB82F1E52u, 0xC7AFE638u, 0x8D22F6E6u}) x ^= x * even;
  return reversed_bits(x);
}

struct Case {
  const char* name;
  Scramble scramble;
  int keys;  ///< 2^keys that pairs are looked at with
};
class OwenScramble : public testing::TestWithParam<Case> {};

TEST(Owen, bits_are_reversed) {
  EXPECT_EQ(reversed_bits(1), 0x80000000u);
  EXPECT_EQ(reversed_bits(0x12345678u), 0x1E6A2C48u);
}

// Leading bits that agree still do, and the first that do not still do not: words with r common bits have r.
TEST_P(OwenScramble, keeps_common_bits) {
  RandomNumbers random(3, 1, 0);
  for (int i = 0; i < 1000; ++i) {
    const auto x = static_cast<std::uint32_t>(0x1p32 * random.next());
    const auto r = static_cast<std::uint32_t>(32 * random.next());
    const std::uint32_t after = r == 31 ? 0 : static_cast<std::uint32_t>(0x1p32 * random.next()) >> (r + 1);
    const std::uint32_t y = x ^ (1u << (31 - r)) ^ after;
    const auto seed = static_cast<std::uint64_t>(i % 50);
    ASSERT_EQ(std::countl_zero(GetParam().scramble(x, seed, 2) ^ GetParam().scramble(y, seed, 2)), int(r)) << x;
  }
}

/// Of a pair of words that agree in their first r bits and no further, the bits r - 2 .. r + 2 of one and r + 1, r + 2
/// of the other, over keys: 128 cells, equally likely.  The largest chi-squared over its limit of all pairs.
double worst_pair(Scramble scramble, int keys) {
  const Sobol sobol;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs{
      {0, 0x80000000u}, {0, 1u << 29}, {0xFFFFFFFFu, 0x7FFFFFFFu}, {0x55555555u, 0x5555AAAAu}};
  for (std::uint32_t k = 0; k < 12; ++k) pairs.emplace_back(sobol.point<2>(k)[1], sobol.point<2>(k ^ (2u << k % 8))[1]);
  for (std::uint32_t k = 1; k < 9; ++k) pairs.emplace_back(0x9E3779B9u * k, 0x9E3779B9u * k ^ (0x9E3779B9u >> 2 * k));
  double worst = 0;
  for (const auto& [x, y] : pairs) {
    const int r = std::clamp(std::countl_zero(x ^ y), 2, 28);
    test::Cells cells(128);
    for (std::uint64_t seed = 0; seed < 1u << keys; ++seed) {
      const std::uint32_t a = scramble(x, seed, 7), b = scramble(y, seed, 7);
      cells.add((a >> (29 - r) & 31u) << 2 | (b >> (29 - r) & 3u));
    }
    worst = std::max(worst, cells.chi_squared() / test::chi_squared_limit(127, 1e-6 / 24));
  }
  return worst;
}

// Alpha 1e-6 over all pairs.
TEST_P(OwenScramble, throws_coins_that_are_independent_in_pairs) {
  EXPECT_LT(worst_pair(GetParam().scramble, GetParam().keys), 1);
}

TEST(Owen, a_shift_or_a_poor_hash_is_told_from_independent_coins) {
  EXPECT_GT(worst_pair(shifted, 11), 10);
  EXPECT_GT(worst_pair(with_first_constants, 11), 10);
}

struct Integrand {
  std::function<double(double, double)> f;
  double integral, slope, rmse_256, rmse_4096;
};
const Integrand integrands[]{
    {[](double x, double y) { return std::exp(x + y); }, std::pow(std::exp(1.) - 1, 2), -1.43, 5.46e-4, 9.60e-6},
    {[](double x, double y) { return std::max(0., x + y - 1); }, 1. / 6, -1.22, 2.99e-4, 1.07e-5},
    {[](double x, double y) { return x + y < .9 ? 1. : 0.; }, .405, -.744, 5.70e-3, 7.59e-4}};

// Over 100 seeds the root of a mean of squares is off by 1 / sqrt(200) = 7 % (alpha 2e-5 at 30 %, a little more where
// errors are not normal); the slope of six of them, which share their points, by some .03.  Means: 4.9 standard errors
// is alpha 1e-6 for 6 of them, of some 6e-6 by Student's t.  Reference: methods_montecarlo_core.md, section 3.6.
TEST_P(OwenScramble, has_the_errors_of_nested_scrambling) {
  constexpr std::uint64_t seeds = 100;
  const Sobol sobol;
  double squares[3][13] = {};
  ScalarMoments last[3];
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    double sum[3] = {};
    for (std::uint32_t k = 0; k < 4096; ++k) {
      const auto x = sobol.point<2>(k);
      const double u = inside_unit(GetParam().scramble(x[0], seed, 0)),
                   v = inside_unit(GetParam().scramble(x[1], seed, 1));
      for (int i = 0; i < 3; ++i) sum[i] += integrands[i].f(u, v);
      if (!std::has_single_bit(k + 1)) continue;
      for (int i = 0; i < 3; ++i)
        squares[i][std::countr_zero(k + 1)] += std::pow(sum[i] / (k + 1) - integrands[i].integral, 2);
      for (int i = 0; i < 3 && k == 255; ++i) last[i].add(sum[i] / 256 - integrands[i].integral);
    }
  }
  for (int i = 0; i < 3; ++i) {
    const auto rmse = [&](int m) { return std::sqrt(squares[i][m] / seeds); };
    std::vector<double> x, y;
    for (int m = 7; m <= 12; ++m) x.push_back(m), y.push_back(std::log2(rmse(m)));
    EXPECT_NEAR(test::slope(x, y), integrands[i].slope, .1) << i;
    EXPECT_NEAR(rmse(8) / integrands[i].rmse_256, 1, .3) << i;
    EXPECT_NEAR(rmse(12) / integrands[i].rmse_4096, 1, .3) << i;
    EXPECT_LT(std::abs(last[i].mean()), 4.9 * last[i].standard_error()) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Both, OwenScramble,
                         testing::Values(Case{"exact", owen_scrambled_exactly, 12}, Case{"fast", fast, 16}),
                         [](const auto& each) { return each.param.name; });

}  // namespace
}  // namespace interflect::core

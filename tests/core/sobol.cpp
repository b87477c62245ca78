#include "core/sobol.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "core/random.h"

namespace interflect::core {
namespace {

// The first points of dimensions 0 .. 3 by hand from the direction numbers; dimension 0 reverses the bits of k.
TEST(Sobol, first_points_are_the_published_ones) {
  const Sobol sobol;
  const auto at = [&](std::uint32_t k, std::size_t d) { return sobol.point<4>(k)[d] * 0x1p-32; };
  const std::vector<std::array<double, 4>> expected{{0, 0, 0, 0},
                                                    {.5, .5, .5, .5},
                                                    {.25, .75, .75, .75},
                                                    {.75, .25, .25, .25},
                                                    {.125, .625, .375, .125},
                                                    {.625, .125, .875, .625},
                                                    {.375, .375, .625, .875},
                                                    {.875, .875, .125, .375}};
  for (std::uint32_t k = 0; k < 8; ++k)
    for (std::size_t d = 0; d < 4; ++d) EXPECT_EQ(at(k, d), expected[k][d]) << k << ' ' << d;
}

std::vector<Sobol> sequences() { return {Sobol(), Sobol::scrambled(1), Sobol::scrambled(2)}; }

TEST(Sobol, every_dimension_has_one_point_in_each_interval) {
  for (const Sobol& sobol : sequences())
    for (const std::uint32_t first : {0u, 1024u, 3072u})
      for (std::size_t d = 0; d < Sobol::dimensions; ++d) {
        std::set<std::uint32_t> intervals;
        for (std::uint32_t k = first; k < first + 1024; ++k) intervals.insert(sobol.point<8>(k)[d] >> 22);
        EXPECT_EQ(intervals.size(), 1024u) << d;
      }
}

// A digital shift maps elementary rectangles onto each other, and so keeps this too.
TEST(Sobol, dimensions_0_and_1_have_one_point_in_each_elementary_rectangle) {
  const RandomBlock shift = random_block(5, 0, 0, 0);
  for (const Sobol& sobol : sequences())
    for (std::uint32_t m = 0; m <= 12; ++m)
      for (const std::uint32_t block : {0u, 1u, 5u, (1u << (32 - std::max(m, 1u))) - 1})
        for (std::uint32_t a = 0; a <= m; ++a) {
          std::vector<bool> met(std::size_t{1} << m);
          for (std::uint32_t k = 0; k < 1u << m; ++k) {
            const auto x = sobol.point<2>((block << m) + k);
            const std::uint64_t column = std::uint64_t{x[0] ^ shift[0]} >> (32 - a);
            const std::uint64_t row = std::uint64_t{x[1] ^ shift[1]} >> (32 - (m - a));
            met[column << (m - a) | row] = true;
          }
          ASSERT_EQ(std::count(met.begin(), met.end(), true), 1 << m) << m << ' ' << block << ' ' << a;
        }
}

// The mean of a product of 1 + (x_d - 1/2) over four dimensions is 1.  Over 64 scrambles and shifts, two-sided at alpha
// 1e-6 by Student's t with 63 degrees of freedom: 5.4 standard errors; and far below the plain 0.35 / 32 of 1024
// independent points.
TEST(Sobol, scrambled_and_shifted_means_are_unbiased_and_better_than_random_ones) {
  constexpr int sets = 64, n = 1024;
  double sum = 0, squares = 0;
  for (std::uint32_t s = 0; s < sets; ++s) {
    const Sobol sobol = Sobol::scrambled(100 + s);
    const RandomBlock shift = random_block(9, 1, s, 0);
    double mean = 0;
    for (std::uint32_t k = 0; k < n; ++k) {
      const auto x = sobol.point<4>(k);
      double product = 1;
      for (std::size_t d = 0; d < 4; ++d) product *= 0.5 + inside_unit(x[d] ^ shift[d]);
      mean += product / n;
    }
    sum += mean - 1;
    squares += (mean - 1) * (mean - 1);
  }
  const double deviation = std::sqrt(squares / sets);
  EXPECT_LT(std::abs(sum / sets), 5.4 * deviation / std::sqrt(sets));
  EXPECT_LT(deviation, 0.1 * std::sqrt((std::pow(13.0 / 12, 4) - 1) / n));
}

TEST(Sobol, scrambles_are_functions_of_their_seed) {
  EXPECT_EQ(Sobol::scrambled(3).point<8>(77), Sobol::scrambled(3).point<8>(77));
  EXPECT_NE(Sobol::scrambled(3).point<8>(77), Sobol::scrambled(4).point<8>(77));
}

TEST(Sobol, words_are_numbers_inside_the_unit_interval) {
  EXPECT_GT(inside_unit(0), 0.0);
  EXPECT_LT(inside_unit(~0u), 1.0);
}

}  // namespace
}  // namespace interflect::core

#include "tests/core/sequence/statistics.h"

#include <gtest/gtest.h>

#include "core/random.h"

namespace interflect::core::test {
namespace {

TEST(SequenceStatistics, quantiles_are_the_tabulated_ones) {
  EXPECT_NEAR(upper_z(.025), 1.959964, 1e-6);
  EXPECT_NEAR(upper_z(1e-6), 4.753424, 1e-6);
  EXPECT_NEAR(upper_z(.975), -1.959964, 1e-6);
  EXPECT_NEAR(chi_squared_limit(15, .01), 30.5779, .03);
  EXPECT_NEAR(chi_squared_limit(255, 1e-3), 330.52, .1);
}

// Random numbers pass; those of which one cell in sixteen is met a tenth less often do not, nor those that leave out the
// last cells.
TEST(SequenceStatistics, cells_tell_what_is_not_uniform) {
  Cells good(16), biased(16), short_of(256);
  RandomNumbers random(1, 2, 3);
  for (int k = 0; k < 1 << 16; ++k) {
    const double u = random.next(), v = random.next();
    good.add(interval_of(u, 16));
    biased.add(interval_of(u < 1. / 16 && v < .1 ? .5 : u, 16));
    short_of.add(interval_of(.99 * u, 256));
  }
  EXPECT_TRUE(good.uniform(1e-6)) << good.chi_squared();
  EXPECT_FALSE(biased.uniform(1e-6)) << biased.chi_squared();
  EXPECT_FALSE(short_of.uniform(1e-6)) << short_of.chi_squared();
}

TEST(SequenceStatistics, a_line_has_its_slope) { EXPECT_NEAR(slope({1, 2, 4}, {5, 3, -1}), -2, 1e-14); }

}  // namespace
}  // namespace interflect::core::test

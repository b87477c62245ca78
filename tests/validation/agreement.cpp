#include "validation/agreement.h"

#include <gtest/gtest.h>

#include <limits>

#include "synthetic.h"
#include "validation/statistics.h"

using namespace interflect;
using namespace interflect::validation;

namespace {

Estimate known(double value, double standard_error, double bound = 0) {
  Estimate e = unbiased_estimate(Spectrum(value), Spectrum(standard_error), 100);
  e.error_bound = Spectrum(bound);
  return e;
}

}  // namespace

TEST(Agreement, is_of_what_bounds_and_noise_do_not_explain) {
  const auto scene = synthetic::scene();
  // 10 apart, bounds of 2 and 3: 5 over hypot(3, 4) = 5.
  const std::vector<Estimate> a{known(100, 3, 2), known(7, 1)}, b{known(110, 4, 3), known(7, 1)};
  const Agreement found = agreement(scene, a, b, 3);
  EXPECT_EQ(found.comparisons, 2u);
  EXPECT_NEAR(found.largest_z, 1, 1e-9);
  EXPECT_EQ(found.worst, 0u);
  EXPECT_TRUE(found.agrees());
}

TEST(Agreement, ends_at_the_largest_z_that_chance_allows) {
  const auto scene = synthetic::scene();
  const double z = sidak_z_max(.01, 1);
  const auto beyond = [&](double apart) {
    const std::vector<Estimate> a{known(100, 3)}, b{known(100 + 5 * apart, 4)};
    return agreement(scene, a, b, z).beyond;
  };
  EXPECT_EQ(beyond(z - 1e-6), 0u);
  EXPECT_EQ(beyond(z + 1e-6), 1u);
  EXPECT_EQ(beyond(-z - 1e-6), 1u);
}

// Each a little less, by half a standard error of the difference: none stands out, the mean does.
TEST(Agreement, tells_of_what_is_lost_everywhere_by_the_mean_of_z) {
  const auto scene = synthetic::scene();
  std::vector<Estimate> a, b;
  for (int k = 0; k < 100; ++k) {
    const double value = 10 + k, noise = k % 2 == 0 ? 1 : -1;  // a sample of mean 0 and variance 1
    a.push_back(known(value - 2.5 + 5 * noise, 3));
    b.push_back(known(value, 4));
  }
  const Agreement lost = agreement(scene, a, b, sidak_z_max(.01, 100)), gained = agreement(scene, b, a, 4);
  EXPECT_TRUE(lost.agrees());
  EXPECT_NEAR(lost.mean_z, -.5, 1e-9);  // five of its own standard errors, 1 / sqrt(100)
  EXPECT_NEAR(gained.mean_z, .5, 1e-9);
}

TEST(Agreement, knows_that_exact_answers_may_differ_by_rounding_alone_and_that_unknown_ones_do_not_agree) {
  const auto scene = synthetic::scene();
  const auto agrees = [&](const Estimate& a, const Estimate& b) {
    return agreement(scene, {&a, 1}, {&b, 1}, 3).agrees();
  };
  constexpr double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(agrees(known(0, 0), known(0, 0)));
  EXPECT_TRUE(agrees(known(100, 0), known(100 + 1e-11, 0)));
  EXPECT_FALSE(agrees(known(100, 0), known(100 + 1e-8, 0)));
  EXPECT_FALSE(agrees(known(100, nan), known(100, 0)));
  EXPECT_FALSE(agrees(known(100, inf), known(100, 0)));
  EXPECT_FALSE(agrees(known(nan, 1), known(100, 1)));
  EXPECT_FALSE(agrees(known(100, 1, inf), known(100, 1)));
}

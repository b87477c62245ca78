#include "montecarlo/tally.h"

#include <gtest/gtest.h>

#include <limits>

namespace interflect::montecarlo {
namespace {

TEST(Tally, samples_that_are_not_finite_count_as_zero_are_remembered_and_void_the_bound) {
  Tally a, b;
  a.add(Spectrum(2), 2, 0);
  a.add(Spectrum(4), 4, 1);
  b.add(Spectrum(std::numeric_limits<double>::quiet_NaN()), 1, 2);
  b.add(Spectrum(std::numeric_limits<double>::infinity()), 1, 3);
  EXPECT_EQ(a.estimate(Spectrum(1)).claim, Claim::guaranteed);
  a.merge(b);
  EXPECT_EQ(a.not_finite, 2u);
  EXPECT_EQ(a.first_not_finite, 2u);
  const Estimate found = a.estimate(Spectrum(1));
  EXPECT_EQ(found.samples, 4u);
  EXPECT_EQ(found.value[0], 1.5);
  EXPECT_EQ(found.claim, Claim::none);
  EXPECT_TRUE(std::isinf(found.error_bound[0]));
}

TEST(Tally, a_channel_that_never_scored_has_the_standard_error_of_the_rule_of_three) {
  Tally tally;
  Spectrum sample, largest;
  largest[0] = largest[1] = 5;  // channel 2: nothing emits
  for (std::uint64_t k = 0; k < 100; ++k) {
    sample[0] = static_cast<double>(k % 2);
    tally.add(sample, sample[0], k);
  }
  const Estimate found = tally.estimate(largest);
  EXPECT_NEAR(found.standard_error[0], std::sqrt(0.25 / 99), 1e-15);
  EXPECT_DOUBLE_EQ(found.standard_error[1], 3 * 5 / 100.0);
  EXPECT_EQ(found.standard_error[2], 0);
  EXPECT_TRUE(std::isnan(found.weighed_standard_error));  // what may hide in channel 1 is in no sample
}

// Samples that are a control variate's alone: their noise says nothing of light that none of them found.
TEST(Tally, a_channel_without_light_has_the_rule_of_three_at_least_whatever_a_control_made_of_it) {
  Tally tally, rest;
  for (std::uint64_t k = 0; k < 100; ++k) {
    Spectrum light;
    light[1] = k == 70 ? 5 : 0;
    const double control = k % 2 == 0 ? 1 : -1;
    (k < 30 ? tally : rest).add(light + Spectrum(control), control, k, light);
  }
  EXPECT_TRUE(tally.found_none());
  tally.merge(rest);
  EXPECT_FALSE(tally.found_none());
  const Estimate found = tally.estimate(Spectrum(50));
  EXPECT_DOUBLE_EQ(found.standard_error[0], 3 * 50 / 100.0);
  EXPECT_LT(found.standard_error[1], .2);
  EXPECT_NEAR(tally.estimate(Spectrum(1)).standard_error[0], std::sqrt(1 / 99.0), 1e-15);  // what is more holds
}

// Two channels that never score together: the sum of the two is 1 always, though each has noise.
TEST(Tally, the_noise_of_the_weighted_value_is_measured_and_not_made_up_from_the_channels) {
  Tally tally, rest;
  for (std::uint64_t k = 0; k < 100; ++k) {
    Spectrum sample;
    sample[k % 2 == 0 ? 0 : 1] = 1;
    (k < 30 ? tally : rest).add(sample, sample[0] + sample[1], k);
  }
  tally.merge(rest);
  const Estimate found = tally.estimate(Spectrum::zero());
  EXPECT_NEAR(found.standard_error[0], std::sqrt(0.25 / 99), 1e-15);
  EXPECT_EQ(found.weighed_standard_error, 0);
  EXPECT_EQ(found.samples, 100u);
}

}  // namespace
}  // namespace interflect::montecarlo

#include "core/spectrum.h"

#include <gtest/gtest.h>

#include "core/estimate.h"

namespace interflect {
namespace {

TEST(Spectrum, arithmetic_is_channel_by_channel) {
  Spectrum a, b(2.0);
  for (int c = 0; c < Spectrum::capacity; ++c) a[c] = c + 1;
  const Spectrum s = 2.0 * (a * b) - a / 2 + Spectrum(1.0);
  for (int c = 0; c < Spectrum::capacity; ++c) EXPECT_DOUBLE_EQ(s[c], 4.0 * (c + 1) - (c + 1) / 2.0 + 1);
  EXPECT_EQ(a.max(), Spectrum::capacity);
  EXPECT_TRUE(Spectrum().is_zero());
  EXPECT_FALSE((a * std::nan("")).is_finite());
}

TEST(Estimate, an_error_that_nobody_computed_is_infinite) {
  const Estimate untouched;
  EXPECT_TRUE(std::isinf(untouched.error_bound[0]));
  EXPECT_EQ(untouched.claim, Claim::none);
}

}  // namespace
}  // namespace interflect

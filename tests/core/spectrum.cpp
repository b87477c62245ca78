#include "core/spectrum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

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

TEST(Spectrum, has_roots_magnitudes_and_maxima_channel_by_channel) {
  Spectrum a, b;
  for (int c = 0; c < Spectrum::capacity; ++c) a[c] = c % 2 == 0 ? c + 1 : -(c + 1), b[c] = 2.5;
  const Spectrum root = sqrt(a * a), magnitude = abs(a), larger = max(a, b);
  for (int c = 0; c < Spectrum::capacity; ++c) {
    EXPECT_EQ(root[c], c + 1);
    EXPECT_EQ(magnitude[c], c + 1);
    EXPECT_EQ(larger[c], std::max(a[c], 2.5));
    EXPECT_EQ(max(b, a)[c], larger[c]);
  }
}

TEST(Spectrum, a_maximum_never_drops_a_nan) {
  const Spectrum one(1.0), none(std::nan(""));
  EXPECT_TRUE(std::isnan(max(one, none)[0]));
  EXPECT_TRUE(std::isnan(max(none, one)[0]));
}

TEST(Estimate, an_error_that_nobody_computed_is_infinite) {
  const Estimate untouched;
  EXPECT_TRUE(std::isinf(untouched.error_bound[0]));
  EXPECT_EQ(untouched.claim, Claim::none);
}

}  // namespace
}  // namespace interflect

#include "core/moments.h"

#include <gtest/gtest.h>

#include "core/random.h"

namespace interflect::core {
namespace {

TEST(Moments, a_large_offset_does_not_spoil_the_variance) {
  Moments m;
  for (double x : {4.0, 7.0, 13.0, 16.0}) m.add(Spectrum(1e9 + x));
  EXPECT_EQ(m.mean()[0], 1e9 + 10);
  EXPECT_EQ(m.variance()[0], 30.0);
  EXPECT_DOUBLE_EQ(m.standard_error()[0], std::sqrt(7.5));
}

TEST(Moments, merging_parts_equals_adding_all) {
  Moments all, left, right;
  for (int i = 0; i < 1000; ++i) {
    const Spectrum x(RandomNumbers(1, 0, static_cast<std::uint64_t>(i)).next());
    all.add(x);
    (i < 300 ? left : right).add(x);
  }
  left.merge(right);
  EXPECT_EQ(left.count(), all.count());
  EXPECT_NEAR(left.mean()[0], all.mean()[0], 1e-14);
  EXPECT_NEAR(left.variance()[0] / all.variance()[0], 1, 1e-13);
}

TEST(Moments, a_number_is_a_channel_by_itself) {
  Moments all;
  ScalarMoments number, rest;
  for (int i = 0; i < 100; ++i) {
    const double x = RandomNumbers(2, 0, static_cast<std::uint64_t>(i)).next();
    all.add(Spectrum(x));
    (i < 60 ? number : rest).add(x);
  }
  number.merge(rest);
  EXPECT_NEAR(number.mean(), all.mean()[0], 1e-15);
  EXPECT_NEAR(number.standard_error(), all.standard_error()[0], 1e-15);
  EXPECT_TRUE(std::isinf(ScalarMoments().standard_error()));
}

TEST(Moments, one_sample_knows_nothing_of_its_error) {
  Moments m;
  m.add(Spectrum(1.0));
  EXPECT_TRUE(std::isinf(m.standard_error()[0]));
  m.merge(Moments());
  EXPECT_EQ(m.count(), 1u);
}

}  // namespace
}  // namespace interflect::core

#include "geometry/segment.h"

#include <gtest/gtest.h>

namespace interflect::geometry {
namespace {

TEST(Segment, is_as_far_from_a_point_as_its_nearest_point) {
  const Vec3 from(1, 0, 0), to(3, 0, 0);
  for (const double scale : {1e-6, 1.0, 1e6}) {
    const auto distance = [&](const Vec3& x) {
      return distance_to_segment(scale * x, scale * from, scale * to) / scale;
    };
    EXPECT_DOUBLE_EQ(distance({2, 3, 4}), 5);
    EXPECT_DOUBLE_EQ(distance({-2, 4, 0}), 5) << "before its begin";
    EXPECT_DOUBLE_EQ(distance({6, 0, 4}), 5) << "past its end";
    EXPECT_EQ(distance({1.5, 0, 0}), 0);
  }
  EXPECT_DOUBLE_EQ(distance_to_segment({1, 3, 4}, from, from), 5) << "a point";
}

}  // namespace
}  // namespace interflect::geometry

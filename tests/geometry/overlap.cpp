#include "geometry/overlap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "geometry/polygon.h"
#include "shapes.h"

namespace interflect::geometry {
namespace {

using test::Dice;
using Triangle = std::array<Vec3, 3>;

TEST(Overlap, equals_the_area_of_the_common_part) {
  const Triangle a{Vec3(0, 0, 1), Vec3(4, 0, 1), Vec3(0, 4, 1)};
  const Triangle b{Vec3(0, 0, 1), Vec3(0, 2, 1), Vec3(2, 0, 1)};  // inside, the other way round
  EXPECT_DOUBLE_EQ(overlap_area(a, b), 2);
  EXPECT_DOUBLE_EQ(overlap_area(b, a), 2);
  const Triangle c{Vec3(2, 0, 1), Vec3(6, 0, 1), Vec3(2, 4, 1)};
  EXPECT_DOUBLE_EQ(overlap_area(a, c), 2);
  const Triangle beside{Vec3(4, 0, 1), Vec3(4, 4, 1), Vec3(0, 4, 1)};  // shares the hypotenuse
  EXPECT_NEAR(overlap_area(a, beside), 0, 1e-14);
}

TEST(Overlap, triangles_of_very_different_size_agree_either_way) {
  Dice dice(31);
  for (int k = 0; k < 100; ++k) {
    const Vec3 n = dice.direction();
    const auto axes = test::frame(n);
    const auto at = [&](double x, double y) -> Vec3 { return x * axes.first + y * axes.second + 3 * n; };
    const Triangle large{at(0, 0), at(100, 0), at(0, 100)};
    const double x = dice.in(-1, 1), y = dice.in(-1, 1);
    const Triangle small{at(x, y), at(x + 0.5, y),
                         at(x, y + 0.5)};  // 40 000 times smaller, across the large one's corner
    EXPECT_NEAR(overlap_area(large, small), overlap_area(small, large), 1e-12);
  }
}

// Two quads a quarter of whose areas is shared, in a plane that no axis is parallel to.  Far from the origin their
// corners are rounded; brought back (differences of such coordinates are exact) they are the same quads, and so is the
// shared area, to the rounding of numbers of their own size.
TEST(Overlap, of_quads_is_as_exact_far_from_the_origin) {
  Dice dice(32);
  for (const double distance : {0.0, 1e4, 5e6, 1e9})
    for (int k = 0; k < 50; ++k) {
      const auto axes = test::frame(dice.direction());
      const Vec3 far = distance * dice.direction();
      const auto quad = [&](double x, double y) {
        Ring ring;
        for (const auto& [u, v] : {std::pair{0, 0}, {2, 0}, {2, 2}, {0, 2}})
          ring.push_back(far + (x + u) * axes.first + (y + v) * axes.second);
        return ring;
      };
      Ring a = quad(0, 0), b = quad(1, 1);
      if (k % 2 == 1) std::reverse(b.begin(), b.end());
      const double there = overlap_area(a, b);
      EXPECT_NEAR(there, 1, 1e-14 + 1e-15 * distance);
      for (Ring* ring : {&a, &b})
        for (Vec3& x : *ring) x -= far;
      EXPECT_NEAR(there, overlap_area(a, b), 1e-14) << distance;
    }
}

}  // namespace
}  // namespace interflect::geometry

#include "geometry/clip.h"

#include <gtest/gtest.h>

#include "shapes.h"

namespace interflect::geometry {
namespace {

using test::Dice;
using test::rectangle;

Ring random_quad(Dice& dice, const Vec3& normal, double size) {
  const auto [u, v] = test::frame(normal);
  const Vec3 c = dice.point(size);
  Ring ring;
  for (int k = 0; k < 4; ++k) {  // on an ellipse: convex
    const double phi = 2 * pi * (k + dice.in(0.05, 0.95)) / 4;
    ring.push_back(c + size * (std::cos(phi) * u + 0.6 * std::sin(phi) * v));
  }
  return ring;
}

TEST(Clip, the_parts_on_both_sides_of_a_plane_make_up_the_whole) {
  Dice dice(30);
  for (const double size : {1e-6, 1.0, 1e6})
    for (int k = 0; k < 200; ++k) {
      const Vec3 normal = dice.direction();
      const Ring ring = random_quad(dice, normal, size);
      const Vec3 n = dice.direction();
      const Plane plane{n, n.dot(dice.point(size))};
      const ConvexRing front = clip(ring, plane), back = clip(ring, {-plane.normal, -plane.offset});
      EXPECT_LE(front.corners, 5);
      const Vec3 sum = vector_area(front.ring()) + vector_area(back.ring());
      EXPECT_NEAR((sum - vector_area(ring)).norm(), 0, 1e-14 * size * size * 10);
      for (const Vec3& x : front.ring()) EXPECT_GE(plane.distance(x), -1e-14 * size * 10);
    }
}

TEST(Clip, neighbours_cut_by_one_plane_get_the_same_new_corner) {
  const Vec3 a(0.1, 0.2, -0.7), b(0.33, -0.4, 0.9);
  const Ring left{a, b, {-1, 0, 0}}, right{b, a, {1, 0, 0}};
  const Plane plane{Vec3(1, 2, 3).normalized(), 0.1};
  const ConvexRing l = clip(left, plane), r = clip(right, plane);
  int shared = 0;
  for (const Vec3& x : l.ring())
    for (const Vec3& y : r.ring()) shared += x == y;
  EXPECT_EQ(shared, 2);  // the corner in front, and the new one
}

TEST(Clip, corners_on_the_plane_belong_to_the_front) {
  const Ring square = rectangle(0, 0, 1, 1);
  EXPECT_EQ(clip(square, {Vec3::UnitX(), 0}).corners, 4);
  EXPECT_EQ(clip(square, {-Vec3::UnitX(), 0}).corners, 0);  // an edge alone is nothing
  EXPECT_EQ(clip(square, {Vec3::UnitZ(), 0}).corners, 0);   // nor is a polygon in the plane
  EXPECT_EQ(clip(square, {Vec3(1, -1, 0).normalized(), 0}).corners, 3);
}

}  // namespace
}  // namespace interflect::geometry

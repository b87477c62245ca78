#include "geometry/shaft.h"

#include <gtest/gtest.h>

#include "shapes.h"

namespace interflect::geometry {
namespace {

using test::Dice;
using test::rectangle;

/// A point of a convex ring, uniform enough.
Vec3 point_of(Dice& dice, const Ring& ring) {
  Vec3 sum = Vec3::Zero();
  double total = 0;
  for (const Vec3& x : ring) {
    const double w = -std::log(dice.in(1e-12, 1));
    sum += w * x;
    total += w;
  }
  return sum / total;
}

bool blocks(const std::array<Vec3, 3>& t, const Vec3& from, const Vec3& to) {
  const Vec3 d = to - from, u = t[1] - t[0], v = t[2] - t[0], p = d.cross(v);
  const double det = u.dot(p);
  if (det == 0) return false;
  const Vec3 s = from - t[0], q = s.cross(u);
  const double a = s.dot(p) / det, b = d.dot(q) / det, w = v.dot(q) / det;
  return a > 0 && b > 0 && a + b < 1 && w > 1e-9 && w < 1 - 1e-9;
}

Ring random_patch(Dice& dice, const Vec3& centre, const Vec3& normal, double size) {
  const auto [u, v] = test::frame(normal);
  const int corners = dice.in(0, 1) < 0.5 ? 3 : 4;
  Ring ring;
  for (int k = 0; k < corners; ++k) {
    const double phi = 2 * pi * (k + dice.in(0.05, 0.95)) / corners;
    ring.push_back(centre + size * (std::cos(phi) * u + dice.in(0.5, 1) * 0.01 * u + std::sin(phi) * v));
  }
  return ring;
}

/// Segments between points of a and b that leave both to the front, tried against the triangle.
bool some_segment_is_blocked(Dice& dice, const Ring& a, const Ring& b, const std::array<Vec3, 3>& triangle) {
  const Vec3 na = vector_area(a).normalized(), nb = vector_area(b).normalized();
  for (int k = 0; k < 60; ++k) {
    const Vec3 x = point_of(dice, a), y = point_of(dice, b);
    if (na.dot(y - x) > 0 && nb.dot(x - y) > 0 && blocks(triangle, x, y)) return true;
  }
  return false;
}

TEST(Shaft, never_excludes_a_triangle_that_blocks) {
  Dice dice(50);
  int blocked = 0, cleared = 0;
  for (const double size : {1e-6, 1.0, 1e6})
    for (int k = 0; k < 4000; ++k) {
      const Vec3 ca = size * dice.point(2), cb = size * dice.point(2);
      const Ring a =
          random_patch(dice, ca, dice.direction(), size * dice.in(0.01, 1));  // facing or not, crossing or not
      const Ring b = random_patch(dice, cb, dice.direction(), size * dice.in(0.01, 1));
      const Vec3 c = ca + dice.in(0, 1) * (cb - ca) + size * dice.point(0.5);
      const double reach = size * dice.in(0.05, 2);
      const std::array<Vec3, 3> t{c + reach * dice.point(1), c + reach * dice.point(1), c + reach * dice.point(1)};
      const Shaft shaft(a, b);
      const bool may = shaft.may_block(t);
      Box box(t[0]);
      box.extend(t[1]).extend(t[2]);
      EXPECT_TRUE(!may || shaft.may_block(box));
      cleared += !may;
      if (!some_segment_is_blocked(dice, a, b, t)) continue;
      ++blocked;
      ASSERT_TRUE(may) << "size " << size << " case " << k;
    }
  EXPECT_GT(blocked, 500);   // the test has seen blockers,
  EXPECT_GT(cleared, 3000);  // and the shaft is of use
}

TEST(Shaft, is_the_convex_hull_for_patches_that_face_each_other) {
  // Two unit squares a metre apart: the hull is the unit cube, and tests by planes are exact for small triangles beside
  // it.
  Ring top = rectangle(0, 0, 1, 1, 1);
  std::reverse(top.begin(), top.end());
  const Shaft shaft(rectangle(0, 0, 1, 1), top);
  const auto speck = [](const Vec3& x) {
    return std::array<Vec3, 3>{x, x + Vec3(1e-4, 0, 1e-5), x + Vec3(0, 1e-4, 1e-5)};
  };
  Dice dice(51);
  for (int k = 0; k < 1000; ++k) {
    const Vec3 x = Vec3(0.5, 0.5, 0.5) + dice.point(1);
    const bool inside = (x.array() > 0).all() && (x.array() < 1).all();
    const bool beside = (x.array() < -2e-4).any() || (x.array() > 1 + 2e-4).any();
    EXPECT_TRUE(!inside || shaft.may_block(speck(x)));
    EXPECT_FALSE(beside && shaft.may_block(speck(x)));
  }
}

TEST(Shaft, the_surfaces_of_a_convex_room_never_block_each_other) {
  // Elements of all six walls of a room, some of which touch along edges: no wall lies between two of them.
  const Box room(Vec3(0, 0, 0), Vec3(5, 4, 3));
  std::vector<Ring> elements, walls;
  for (int axis = 0; axis < 3; ++axis)
    for (const bool upper : {false, true}) {
      const int u = (axis + 1) % 3, v = (axis + 2) % 3, n = 3;
      const auto at = [&](double s, double t) {
        Vec3 x = upper ? room.max() : room.min();
        x[u] = s * room.max()[u];
        x[v] = t * room.max()[v];
        return x;
      };
      const auto cell = [&](double s0, double t0, double s1, double t1) {
        Ring ring{at(s0, t0), at(s1, t0), at(s1, t1), at(s0, t1)};
        if (upper) std::reverse(ring.begin(), ring.end());  // inwards
        return ring;
      };
      walls.push_back(cell(0, 0, 1, 1));
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) elements.push_back(cell(i / 3.0, j / 3.0, (i + 1) / 3.0, (j + 1) / 3.0));
    }
  for (std::size_t i = 0; i < elements.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      if (i / 9 == j / 9) continue;  // one wall
      const Shaft shaft(elements[i], elements[j]);
      for (const Ring& wall : walls) {
        EXPECT_FALSE(shaft.may_block(wall[0], wall[1], wall[2]));
        EXPECT_FALSE(shaft.may_block(wall[0], wall[2], wall[3]));
      }
    }
}

TEST(Shaft, a_blocker_that_barely_enters_counts) {
  Ring top = rectangle(0, 0, 1, 1, 1);
  std::reverse(top.begin(), top.end());
  const Shaft shaft(rectangle(0, 0, 1, 1), top);
  EXPECT_TRUE(shaft.may_block(Vec3(1 - 1e-9, 0.5, 0.5), Vec3(2, 0.4, 0.5), Vec3(2, 0.6, 0.5)));
  EXPECT_TRUE(shaft.may_block(Vec3(0.2, 0.2, 1e-9), Vec3(0.8, 0.2, 1e-9), Vec3(0.2, 0.8, 1e-9)));
  EXPECT_FALSE(shaft.may_block(Vec3(0.2, 0.2, 0), Vec3(0.8, 0.2, 0), Vec3(0.2, 0.8, 0)));
  EXPECT_FALSE(shaft.may_block(Box(Vec3(0, 0, -1), Vec3(1, 1, 0))));  // what lies in a patch's plane, or behind it
  EXPECT_TRUE(shaft.may_block(Box(Vec3(0, 0, -1), Vec3(1, 1, 1e-9))));
}

TEST(Shaft, holds_far_from_the_origin) {
  const Vec3 far = Vec3::Constant(1e9);
  Ring bottom = rectangle(0, 0, 1, 1), top = rectangle(0, 0, 1, 1, 1);
  std::reverse(top.begin(), top.end());
  for (Ring* ring : {&bottom, &top})
    for (Vec3& x : *ring) x += far;
  const Shaft shaft(bottom, top);
  EXPECT_TRUE(shaft.may_block(far + Vec3(0.5, 0.5, 0.5), far + Vec3(0.75, 0.5, 0.5), far + Vec3(0.5, 0.75, 0.5)));
  EXPECT_FALSE(shaft.may_block(far + Vec3(1.5, 0.5, 0.5), far + Vec3(1.75, 0.5, 0.5), far + Vec3(1.5, 0.75, 0.5)));
}

// Two patches and the wall that one of them lies on, brought back from coordinates that are 1e-9 apart: the wall stands
// out of the patch's plane by that, and blocks nothing to whoever knows of it.
TEST(Shaft, forgives_as_much_rounding_as_it_is_told_of) {
  const Ring patch = rectangle(0.4, 0.4, 0.6, 0.6), wall = rectangle(0, 0, 1, 1, 1e-9);
  Ring top = rectangle(0, 0, 1, 1, 1);
  std::reverse(top.begin(), top.end());
  const Shaft strict(patch, top), told(patch, top, 4e-9);
  EXPECT_TRUE(strict.may_block(wall[0], wall[1], wall[2]));
  EXPECT_FALSE(told.may_block(wall[0], wall[1], wall[2]));
  EXPECT_TRUE(told.may_block(Vec3(0.2, 0.2, 1e-8), Vec3(0.8, 0.2, 1e-8), Vec3(0.2, 0.8, 1e-8)));
}

}  // namespace
}  // namespace interflect::geometry

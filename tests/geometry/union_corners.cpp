#include "geometry/union_corners.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "exact_polygons.h"
#include "shapes.h"

namespace interflect::geometry {
namespace {

using test::Dice;
using test::rectangle;

std::size_t corners(const std::vector<Ring>& rings) {
  RingList list;
  for (const Ring& ring : rings) list.push_back(ring);
  UnionCorners of;
  return of(list, Vec3::UnitZ(), 1e-9).size();
}

TEST(UnionCorners, of_cut_up_figures_are_those_of_the_figures) {
  EXPECT_EQ(corners({}), 0u);
  EXPECT_EQ(corners({rectangle(0, 0, 1, 1)}), 4u);
  EXPECT_EQ(corners({rectangle(0, 0, 1, 1), rectangle(1, 0, 3, 1)}), 4u) << "two halves";
  EXPECT_EQ(corners({rectangle(0, 0, 1, 3), rectangle(1, 0, 2, 1)}), 6u)
      << "an L, a corner of one part within an edge of the other";
  EXPECT_EQ(corners({rectangle(0, 0, 3, 1), rectangle(0, 2, 3, 3), rectangle(0, 1, 1, 2), rectangle(2, 1, 3, 2)}), 8u)
      << "around a hole";
}

std::size_t corners_of(const test::ExactSet& set) {
  std::size_t count = 0;
  for (const auto& part : test::parts_of(set)) {
    count += part.outer_boundary().size();
    for (auto hole = part.holes_begin(); hole != part.holes_end(); ++hole) count += hole->size();
  }
  return count;
}

// What is seen of a rectangle past up to nine triangles anywhere before it.
TEST(UnionCorners, of_what_is_seen_past_triangles_are_those_of_exact_booleans) {
  Dice dice(17);
  for (int k = 0; k < 100; ++k) {
    const Ring target = rectangle(-1, -1, dice.in(0, 1), dice.in(0, 1), 1);
    test::ExactSet seen(test::projection(target));
    HiddenPart part;
    part.start(target);
    for (int i = 0; i < 1 + k % 9; ++i) {
      const auto corner = [&] {
        const double z = dice.in(0.2, 0.9);
        return Vec3(z * dice.in(-1.2, 1.2), z * dice.in(-1.2, 1.2), z);
      };
      const Ring triangle{corner(), corner(), corner()};
      seen.difference(test::projection(triangle));
      std::vector<HalfSpace> shadow;
      ASSERT_TRUE(ConvexBlocker::polygon(triangle).append_shadow(Vec3::Zero(), 1e-12, shadow));
      part.hide(shadow);
    }
    UnionCorners of;
    EXPECT_EQ(of(part.seen(), Vec3::UnitZ(), 1e-9).size(), corners_of(seen)) << k;
  }
}

std::vector<Ring> faces_of(const Vec3& low, const Vec3& high) {
  std::vector<Ring> faces;
  for (int axis = 0; axis < 3; ++axis)
    for (const bool upper : {false, true}) {
      Ring ring(4, upper ? high : low);
      for (int k = 0; k < 4; ++k) {
        ring[std::size_t(k)][(axis + 1) % 3] = (k == 1 || k == 2 ? high : low)[(axis + 1) % 3];
        ring[std::size_t(k)][(axis + 2) % 3] = (k >= 2 ? high : low)[(axis + 2) % 3];
      }
      if (!upper) std::reverse(ring.begin(), ring.end());
      faces.push_back(ring);
    }
  return faces;
}

// Upright edges of both boxes cast shadows whose lines all meet straight above the eye, where cuts leave slivers.
TEST(UnionCorners, of_what_is_seen_past_boxes_whose_edges_are_parallel_are_those_of_exact_booleans) {
  Dice dice(18);
  for (int k = 0; k < 200; ++k) {
    const Vec3 eye(dice.in(-3, 4), dice.in(-3, 4), 0);
    const auto seen_from = [&](Ring ring) {
      for (Vec3& x : ring) x -= eye;
      return ring;
    };
    const Ring target = seen_from(rectangle(-2, -2, 6, 5, 3));
    test::ExactSet seen(test::projection(target));
    HiddenPart part;
    part.start(target);
    for (const auto& [low, high] :
         {std::pair(Vec3(1, 1, 0.2), Vec3(2, 2, 1.2)), std::pair(Vec3(2.5, 1.5, 0.5), Vec3(4, 3, 2))}) {
      std::vector<Ring> faces;
      for (const Ring& face : faces_of(low, high)) faces.push_back(seen_from(face));
      for (const Ring& face : faces) seen.difference(test::projection(face));
      std::vector<HalfSpace> shadow;
      ASSERT_TRUE(ConvexBlocker::solid(faces).append_shadow(Vec3::Zero(), 1e-12, shadow));
      part.hide(shadow);
    }
    UnionCorners of;
    EXPECT_EQ(of(part.seen(), Vec3::UnitZ(), 1e-9).size(), corners_of(seen)) << k << ": " << eye.transpose();
  }
}

}  // namespace
}  // namespace interflect::geometry

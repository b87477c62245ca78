#include "geometry/hidden_part.h"

#include <gtest/gtest.h>

#include "exact_polygons.h"
#include "shapes.h"

namespace interflect::geometry {
namespace {

using test::Dice;
using test::ExactSet;
using test::projection;
using test::rectangle;

constexpr double rounding = 1e-12;

/// Hidden area of a ring seen from the origin; checks that hidden and seen make up the whole, and that each ring keeps
/// its orientation.
double hidden_area(const Ring& ring, std::span<const ConvexBlocker> blockers) {
  HiddenPart part;
  part.start(ring);
  for (const ConvexBlocker& blocker : blockers) {
    std::vector<HalfSpace> shadow;
    if (blocker.append_shadow(Vec3::Zero(), rounding, shadow)) part.hide(shadow);
  }
  const Vec3 whole = vector_area(ring), normal = whole.normalized();
  double hidden = 0, seen = 0;
  for (std::size_t k = 0; k < part.hidden().size(); ++k) hidden += vector_area(part.hidden()[k]).dot(normal);
  for (std::size_t k = 0; k < part.seen().size(); ++k) seen += vector_area(part.seen()[k]).dot(normal);
  EXPECT_NEAR(hidden + seen, whole.norm(), 1e-14 * whole.norm());
  EXPECT_GE(hidden, -1e-15 * whole.norm());
  EXPECT_GE(seen, -1e-15 * whole.norm());
  return hidden;
}

std::vector<Ring> cube_faces(const Vec3& low, const Vec3& high) {
  const auto at = [&](int i, int j, int k) {
    return Vec3(i ? high.x() : low.x(), j ? high.y() : low.y(), k ? high.z() : low.z());
  };
  return {{at(0, 0, 0), at(0, 1, 0), at(1, 1, 0), at(1, 0, 0)}, {at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1)},
          {at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1)}, {at(0, 1, 0), at(0, 1, 1), at(1, 1, 1), at(1, 1, 0)},
          {at(0, 0, 0), at(0, 0, 1), at(0, 1, 1), at(0, 1, 0)}, {at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1)}};
}

std::vector<BlockingTriangle> triangles_of(std::span<const Ring> faces, bool dark_back = true) {
  std::vector<BlockingTriangle> out;
  for (const Ring& face : faces)
    for (std::size_t k = 2; k < face.size(); ++k) out.push_back({{face[0], face[k - 1], face[k]}, dark_back});
  return out;
}

TEST(HiddenPart, of_a_square_behind_a_square_is_the_overlap_of_its_shadow) {
  const std::vector blocker{ConvexBlocker::polygon(rectangle(0.1, 0.1, 0.4, 0.3, 0.5))};
  EXPECT_NEAR(hidden_area(rectangle(-1, -1, 0.5, 1, 1), blocker), (0.5 - 0.2) * 0.4, 1e-15);
  EXPECT_NEAR(hidden_area(rectangle(-1, -1, 1, 1, 1), blocker), 0.6 * 0.4, 1e-15);
  EXPECT_EQ(hidden_area(rectangle(-1, -1, 0.1, 1, 1), blocker), 0);
  EXPECT_NEAR(hidden_area(rectangle(0.3, 0.3, 0.7, 0.5, 1), blocker), 0.08, 1e-15);
}

TEST(HiddenPart, what_lies_before_or_beside_or_behind_the_eye_hides_nothing) {
  const Ring target = rectangle(-1, -1, 1, 1, 1);
  for (const double z : {1.0, 2.0, -0.5, 0.0})
    EXPECT_EQ(hidden_area(target, std::vector{ConvexBlocker::polygon(rectangle(-0.3, -0.3, 0.3, 0.3, z))}), 0) << z;
  EXPECT_EQ(hidden_area(target, std::vector{ConvexBlocker::polygon(Ring{{0, 0, 0.2}, {0, 0.1, 0.2}, {0, 0.1, 0.9}})}),
            0);
}

// A wall x in [0, 2] at z = 0.5 + x reaches through the plane of the target at x = 0.5: hidden is what lies beyond it,
// 0 < x < 0.5.
TEST(HiddenPart, a_blocker_that_crosses_the_polygon_hides_only_beyond_itself) {
  const std::vector wall{ConvexBlocker::polygon(Ring{{0, -9, 0.5}, {2, -9, 2.5}, {2, 9, 2.5}, {0, 9, 0.5}})};
  EXPECT_NEAR(hidden_area(rectangle(-1, -1, 1, 1, 1), wall), 0.5 * 2, 1e-14);
}

// It reaches behind the horizon of the eye as well: a projection would turn over.
TEST(HiddenPart, a_blocker_across_the_eyes_horizon_is_no_special_case) {
  const std::vector wall{ConvexBlocker::polygon(Ring{{0.1, -5, -5}, {0.1, 5, -5}, {0.1, 5, 0.5}, {0.1, -5, 0.5}})};
  EXPECT_NEAR(hidden_area(rectangle(-1, -1, 1, 1, 1), wall), 0.8 * 2, 1e-14);  // beyond x = 0.1 / 0.5
}

TEST(HiddenPart, a_solid_hides_what_its_faces_hide_together) {
  Dice dice(11);
  for (int k = 0; k < 200; ++k) {
    const Vec3 low(dice.in(-0.4, 0.1), dice.in(-0.4, 0.1), dice.in(0.2, 0.5)),
        high = low + Vec3(dice.in(0.1, 0.4), dice.in(0.1, 0.4), dice.in(0.1, 0.4));
    const auto faces = cube_faces(low, high);
    std::vector<ConvexBlocker> flat;
    for (const Ring& face : faces) flat.push_back(ConvexBlocker::polygon(face));
    const std::vector solid{ConvexBlocker::solid(faces)};
    const Ring target = rectangle(dice.in(-2, -0.2), dice.in(-2, -0.2), dice.in(0, 2), dice.in(0, 2), 1);
    const double by_faces = hidden_area(target, flat);
    EXPECT_NEAR(hidden_area(target, solid), by_faces, 1e-13);
  }
}

TEST(HiddenPart, a_solid_through_the_polygon_hides_what_its_faces_hide) {
  Dice dice(12);
  for (int k = 0; k < 200; ++k) {
    const Vec3 low(dice.in(-0.4, 0.1), dice.in(-0.4, 0.1), dice.in(0.2, 0.9)),
        high = low + Vec3(dice.in(0.1, 0.4), dice.in(0.1, 0.4), 0.9);
    const auto faces = cube_faces(low, high);
    std::vector<ConvexBlocker> flat;
    for (const Ring& face : faces) flat.push_back(ConvexBlocker::polygon(face));
    const Ring target{{-1, -1, 0.8}, {1, -1, 1.4}, {1, 1, 1.4}, {-1, 1, 0.8}};
    EXPECT_NEAR(hidden_area(target, std::vector{ConvexBlocker::solid(faces)}), hidden_area(target, flat), 1e-13);
  }
}

TEST(ConvexBlockers, of_a_cut_up_box_are_one_solid_and_of_an_inside_out_one_are_six_walls) {
  auto faces = cube_faces({0, 0, 0}, {1, 2, 3});
  EXPECT_EQ(convex_blockers(triangles_of(faces), 1e-12).size(), 1u);
  EXPECT_FALSE(convex_blockers(triangles_of(faces), 1e-12)[0].flat());
  EXPECT_EQ(convex_blockers(triangles_of(faces), 1e-12)[0].faces().size(), 6u);
  EXPECT_EQ(convex_blockers(triangles_of(faces, false), 1e-12).size(), 6u);  // light leaves the insides too
  for (Ring& face : faces) std::reverse(face.begin(), face.end());
  EXPECT_EQ(convex_blockers(triangles_of(faces), 1e-12).size(), 6u);
  faces.pop_back();
  EXPECT_EQ(convex_blockers(triangles_of(faces), 1e-12).size(), 5u);
}

TEST(ConvexBlockers, join_triangles_only_where_they_stay_convex_and_flat) {
  const Ring ell{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}};
  const std::vector<BlockingTriangle> triangles{{{ell[0], ell[1], ell[2]}, false},
                                                {{ell[0], ell[2], ell[3]}, false},
                                                {{ell[0], ell[3], ell[4]}, false},
                                                {{ell[0], ell[4], ell[5]}, false}};
  const auto blockers = convex_blockers(triangles, 1e-12);
  EXPECT_EQ(blockers.size(), 2u);
  double area = 0;
  for (const ConvexBlocker& b : blockers) area += vector_area(b.faces()[0]).norm();
  EXPECT_DOUBLE_EQ(area, 3);
  const std::vector<BlockingTriangle> bent{{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0)}, false},
                                           {{Vec3(0, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0.01)}, false}};
  EXPECT_EQ(convex_blockers(bent, 1e-12).size(), 2u);
}

TEST(ConvexBlocker, casts_no_shadow_of_its_own_on_an_eye_in_it) {
  const ConvexBlocker solid = ConvexBlocker::solid(cube_faces({0, 0, 0}, {1, 1, 1}));
  std::vector<HalfSpace> shadow;
  EXPECT_FALSE(solid.append_shadow({0.5, 0.5, 0.5}, 1e-9, shadow));
  EXPECT_FALSE(solid.append_shadow({0.5, 0.5, 1}, 1e-9, shadow));
  EXPECT_TRUE(shadow.empty());
  EXPECT_THROW(ConvexBlocker::solid(std::vector<Ring>{rectangle(0, 0, 1, 1)}), Defect);
}

double area_of(const ExactSet& set) {
  test::Exact::FT area = 0;
  for (const auto& part : test::parts_of(set)) {
    area += part.outer_boundary().area();
    for (auto hole = part.holes_begin(); hole != part.holes_end(); ++hole) area += hole->area();  // clockwise: negative
  }
  return CGAL::to_double(area);
}

// Union, not sum: random triangles, many of which share edges or corners, lie in one line of sight, or are there twice.
TEST(HiddenPart, behind_overlapping_touching_and_duplicate_triangles_is_the_exact_union) {
  Dice dice(7);
  for (int k = 0; k < 60; ++k) {
    const Ring target = rectangle(-1, -1, dice.in(0, 1), dice.in(0, 1), 1);
    std::vector<Ring> triangles;
    const int count = 2 + k % 9;
    for (int i = 0; i < count; ++i) {
      const auto corner = [&] {
        const double z = dice.in(0.2, 0.9);
        return Vec3(z * dice.in(-1.2, 1.2), z * dice.in(-1.2, 1.2), z);
      };
      Ring ring{corner(), corner(), corner()};
      if (i > 0 && i % 3 == 0) ring[0] = triangles.back()[0], ring[1] = triangles.back()[1];  // a common edge
      if (i > 0 && i % 4 == 0)
        ring = {0.5 * triangles[0][0], 0.5 * triangles[0][1], ring[2]};  // hides the same edge, halfway
      if (i > 0 && i % 5 == 0) ring = triangles[1];                      // twice
      triangles.push_back(ring);
    }
    ExactSet shadows;
    std::vector<ConvexBlocker> blockers;
    for (const Ring& ring : triangles) {
      shadows.join(projection(ring));
      blockers.push_back(ConvexBlocker::polygon(ring));
    }
    shadows.intersection(projection(target));
    EXPECT_NEAR(hidden_area(target, blockers), area_of(shadows), 1e-14 * 4);
  }
}

}  // namespace
}  // namespace interflect::geometry

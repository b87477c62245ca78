#include "geometry/polygon.h"

#include <gtest/gtest.h>

#include <limits>

#include "shapes.h"

namespace interflect::geometry {
namespace {

using test::Dice;
using test::rectangle;

std::string defect_of(const PlanarPolygon& polygon) {
  try {
    require_valid(polygon);
    return "valid";
  } catch (const Defect& defect) {
    return defect.what();
  }
}

TEST(Polygon, area_of_a_rectangle_with_two_holes_is_that_of_the_rectangle_less_theirs) {
  const PlanarPolygon polygon{rectangle(0, 0, 5, 4),
                              {rectangle(1, 1, 2, 3), {{3, 1, 0}, {3, 3, 0}, {4, 3, 0}, {4, 1, 0}}}};
  EXPECT_EQ(area(polygon), 16);
  require_valid(polygon);
}

TEST(Polygon, vector_area_is_exact_far_from_the_origin) {
  Ring ring = rectangle(0, 0, 2, 3);
  for (Vec3& x : ring) x += Vec3(1e9, -1e9, 1e9);  // representable: the differences are exact
  EXPECT_EQ(vector_area(ring), Vec3(0, 0, 6));
}

TEST(Polygon, vector_area_turns_with_the_orientation) {
  Ring ring = rectangle(0, 0, 2, 3);
  std::reverse(ring.begin(), ring.end());
  EXPECT_EQ(vector_area(ring), Vec3(0, 0, -6));
}

TEST(Polygon, planarity_error_does_not_depend_on_scale_or_place) {
  for (const double scale : {1e-6, 1.0, 1e6}) {
    Ring ring = rectangle(0, 0, 1, 1);
    ring[2].z() = 1e-3;
    for (Vec3& x : ring) x = scale * (x + Vec3(10, 20, 30));
    // Corners z = 0, 0, d, 0: the plane through their mean has all four d/4 away, over a diameter of sqrt(2).
    EXPECT_NEAR(relative_planarity_error({ring, {}}), 0.25e-3 / std::sqrt(2.0), 1e-9);
  }
}

TEST(Polygon, validity_does_not_depend_on_scale_or_place) {
  Dice dice(1);
  for (const double scale : {1e-6, 1.0, 1e6})
    for (int k = 0; k < 50; ++k) {
      const Vec3 normal = dice.direction();
      PlanarPolygon polygon{test::star(dice, 12, scale * dice.point(3), normal, scale), {}};
      EXPECT_EQ(defect_of(polygon), "valid");
    }
  Ring far = rectangle(0, 0, 5, 4);
  for (Vec3& x : far) x += Vec3::Constant(1e9);
  EXPECT_EQ(defect_of({far, {}}), "valid");
}

TEST(Polygon, slender_polygons_are_valid) { EXPECT_EQ(defect_of({rectangle(0, 0, 1000, 0.001), {}}), "valid"); }

TEST(Polygon, each_defect_is_named) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(defect_of({{{0, 0, 0}, {1, 0, 0}}, {}}), "the outline has 2 corners: at least 3 expected");
  EXPECT_EQ(defect_of({{{0, 0, 0}, {1, nan, 0}, {1, 1, 0}}, {}}), "corner 1 of the outline is not finite");
  EXPECT_EQ(defect_of({{{0, 0, 0}, {1, 0, 0}, {1, inf, 0}}, {}}), "corner 2 of the outline is not finite");
  EXPECT_EQ(defect_of({{{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {1, 1, 0}}, {}}), "corners 1 and 2 of the outline coincide");
  EXPECT_EQ(defect_of({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}}, {}}), "corners 3 and 0 of the outline coincide");
  EXPECT_EQ(defect_of({{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, {}}),
            "the outline encloses no area: its corners lie on a line, or it crosses itself");
  EXPECT_NE(defect_of({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0.01}, {0, 1, 0}}, {}}).find("not planar"), std::string::npos);
  EXPECT_EQ(defect_of({{{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {1, -1, 0}}, {}}),
            "the outline crosses or touches itself: the edges after corners 0 and 2 meet");
}

TEST(Polygon, an_outline_that_touches_itself_is_refused) {
  EXPECT_NE(defect_of({{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 0, 0}, {0, 2, 0}}, {}}).find("touches itself"),
            std::string::npos);
  EXPECT_NE(defect_of({{{0, 0, 0}, {2, 0, 0}, {1, 0, 0}, {1, 2, 0}}, {}}).find("touches itself"),
            std::string::npos);  // a spike
}

TEST(Polygon, corners_in_the_middle_of_an_edge_are_allowed) {
  EXPECT_EQ(defect_of({{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}, {}}), "valid");
}

TEST(Polygon, holes_must_lie_inside_and_apart) {
  const Ring outer = rectangle(0, 0, 4, 4);
  EXPECT_EQ(defect_of({outer, {rectangle(5, 5, 6, 6)}}), "hole 0 is not inside the outline");
  EXPECT_EQ(defect_of({outer, {rectangle(1, 1, 2, 2), rectangle(3, 3, 5, 3.5)}}),
            "the outline touches or crosses hole 1");
  EXPECT_EQ(defect_of({outer, {rectangle(0, 1, 2, 2)}}), "the outline touches or crosses hole 0");
  EXPECT_EQ(defect_of({outer, {rectangle(1, 1, 2, 2), rectangle(2, 1, 3, 2)}}), "hole 0 touches or crosses hole 1");
  EXPECT_EQ(defect_of({outer, {rectangle(1, 1, 3, 3), rectangle(1.5, 1.5, 2, 2)}}), "hole 1 lies inside hole 0");
  EXPECT_EQ(defect_of({outer, {{{1, 1, 0}, {2, 1, 0}}}}), "hole 0 has 2 corners: at least 3 expected");
  EXPECT_NE(defect_of({outer, {rectangle(1, 1, 2, 2, 0.5)}}).find("not planar"), std::string::npos);
}

}  // namespace
}  // namespace interflect::geometry

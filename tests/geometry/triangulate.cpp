#include "geometry/triangulate.h"

#include <gtest/gtest.h>

#include <set>

#include "shapes.h"

namespace interflect::geometry {
namespace {

using test::Dice;
using test::rectangle;

double total_area(const std::vector<TriangleCorners>& triangles) {
  double sum = 0;
  for (const auto& t : triangles) sum += vector_area(t).norm();
  return sum;
}

std::set<std::array<double, 3>> corners_of(const std::vector<TriangleCorners>& triangles) {
  std::set<std::array<double, 3>> corners;
  for (const auto& t : triangles)
    for (const Vec3& x : t) corners.insert({x.x(), x.y(), x.z()});
  return corners;
}

TEST(Triangulate, triangles_of_concave_polygons_have_their_area_orientation_and_corners) {
  Dice dice(10);
  for (const double scale : {1e-6, 1.0, 1e6})
    for (int k = 0; k < 40; ++k) {
      const Vec3 normal = dice.direction();
      const PlanarPolygon polygon{test::star(dice, 3 + k, scale * dice.point(5), normal, scale), {}};
      const auto triangles = triangulate(polygon);
      EXPECT_EQ(triangles.size(), polygon.outer.size() - 2);
      EXPECT_NEAR(total_area(triangles), area(polygon), 1e-12 * area(polygon) * static_cast<double>(k + 3));
      for (const auto& t : triangles) EXPECT_GT(vector_area(t).dot(normal), 0);
      std::set<std::array<double, 3>> given;
      for (const Vec3& x : polygon.outer) given.insert({x.x(), x.y(), x.z()});
      EXPECT_EQ(corners_of(triangles), given);  // bit by bit
    }
}

TEST(Triangulate, holes_stay_empty_whichever_way_they_run) {
  Ring second = rectangle(3, 1, 4, 3);
  std::reverse(second.begin(), second.end());
  const PlanarPolygon polygon{rectangle(0, 0, 5, 4), {rectangle(1, 1, 2, 3), second}};
  const auto triangles = triangulate(polygon);
  EXPECT_EQ(triangles.size(), 12u + 2u * 2u - 2u);  // n + 2 holes - 2
  EXPECT_DOUBLE_EQ(total_area(triangles), 16);
  for (const auto& t : triangles) {
    const Vec3 c = (t[0] + t[1] + t[2]) / 3;
    EXPECT_FALSE(c.x() > 1 && c.x() < 2 && c.y() > 1 && c.y() < 3);
    EXPECT_FALSE(c.x() > 3 && c.x() < 4 && c.y() > 1 && c.y() < 3);
  }
}

TEST(Triangulate, a_polygon_a_thousand_million_metres_away_keeps_its_area) {
  PlanarPolygon polygon{rectangle(0, 0, 5, 4), {rectangle(1, 1, 2, 3)}};
  for (Vec3& x : polygon.outer) x += Vec3::Constant(1e9);
  for (Vec3& x : polygon.holes[0]) x += Vec3::Constant(1e9);
  EXPECT_DOUBLE_EQ(total_area(triangulate(polygon)), 18);
}

TEST(Triangulate, clockwise_polygons_give_clockwise_triangles) {
  Ring ring = rectangle(0, 0, 2, 3);
  std::reverse(ring.begin(), ring.end());
  for (const auto& t : triangulate({ring, {}})) EXPECT_LT(vector_area(t).z(), 0);
}

TEST(Triangulate, invalid_polygons_are_refused) {
  EXPECT_THROW(triangulate({{{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {1, -1, 0}}, {}}), Defect);
}

TEST(Triangulate, a_face_whose_hole_is_joined_by_a_double_edge_keeps_the_hole_empty) {
  const Ring keyhole{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {0, 0, 0},
                     {1, 1, 0}, {1, 3, 0}, {3, 3, 0}, {3, 1, 0}, {1, 1, 0}};
  EXPECT_THROW(require_valid({keyhole, {}}), Defect);
  const auto triangles = triangulate_face(keyhole);
  EXPECT_EQ(triangles.size(), 8u);
  EXPECT_DOUBLE_EQ(total_area(triangles), 12);
}

TEST(Triangulate, a_face_that_is_bent_keeps_its_corners) {
  const Ring bent{{0, 0, 0}, {2, 0, 0}, {2, 2, 0.1}, {1, 0.5, 0}, {0, 2, 0}};
  const auto triangles = triangulate_face(bent);
  EXPECT_EQ(triangles.size(), 3u);
  EXPECT_EQ(corners_of(triangles).size(), 5u);
}

TEST(Triangulate, a_face_that_crosses_itself_is_refused) {
  EXPECT_THROW(triangulate_face(Ring{{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {1, -1, 0}}), Defect);
}

}  // namespace
}  // namespace interflect::geometry

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>

#include "geometry/triangulate.h"
#include "shapes.h"

namespace interflect::geometry {
namespace {

using test::Dice;
using test::rectangle;

TriangleCorners corners(const IndexedTriangles& mesh, std::size_t t) {
  return {mesh.vertices[mesh.triangles[t][0]], mesh.vertices[mesh.triangles[t][1]],
          mesh.vertices[mesh.triangles[t][2]]};
}

double smallest_sine(const TriangleCorners& t) {
  const double a = (t[1] - t[0]).norm(), b = (t[2] - t[1]).norm(), c = (t[0] - t[2]).norm();
  return 2 * vector_area(t).norm() * std::min({a, b, c}) / (a * b * c);  // law of sines: sin A = 2 area / (b c)
}

struct Quality {
  double area = 0, longest = 0, smallest_sine = 1;
  std::size_t open_edges = 0, crowded_edges = 0;
  double open_length = 0;
};

Quality measure(const IndexedTriangles& mesh, const Vec3& normal) {
  Quality q;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const TriangleCorners t = corners(mesh, i);
    EXPECT_GT(vector_area(t).dot(normal), 0);
    q.area += vector_area(t).norm();
    q.smallest_sine = std::min(q.smallest_sine, smallest_sine(t));
    for (std::size_t k = 0; k < 3; ++k) {
      q.longest = std::max(q.longest, (t[(k + 1) % 3] - t[k]).norm());
      ++uses[std::minmax({mesh.triangles[i][k], mesh.triangles[i][(k + 1) % 3]})];
    }
  }
  for (const auto& [edge, count] : uses) {
    q.crowded_edges += count > 2;
    if (count != 1) continue;
    ++q.open_edges;
    q.open_length += (mesh.vertices[edge.first] - mesh.vertices[edge.second]).norm();
  }
  return q;
}

TEST(Refine, triangles_are_conforming_short_and_well_shaped) {
  for (const double scale : {1e-6, 1.0, 1e6}) {
    PlanarPolygon polygon{rectangle(0, 0, 5, 4), {rectangle(1, 1, 2, 3), rectangle(3.5, 0.5, 3.55, 3.5)}};
    for (Vec3& x : polygon.outer) x *= scale;
    for (Ring& hole : polygon.holes)
      for (Vec3& x : hole) x *= scale;
    const Quality q = measure(triangulate_refined(polygon, 0.4 * scale), Vec3::UnitZ());
    EXPECT_NEAR(q.area, area(polygon), 1e-12 * area(polygon));
    EXPECT_LE(q.longest, 0.4 * scale * (1 + 1e-12));
    EXPECT_GT(q.smallest_sine, std::sin(20 * pi / 180));
    EXPECT_EQ(q.crowded_edges, 0u);
    // Conforming: what is open is the rim, 18 + 6 + 6.1 long.
    EXPECT_NEAR(q.open_length, 30.1 * scale, 1e-9 * scale);
  }
}

TEST(Refine, polygons_in_any_plane_are_covered_once) {
  Dice dice(20);
  for (int k = 0; k < 20; ++k) {
    const Vec3 normal = dice.direction();
    const PlanarPolygon polygon{test::star(dice, 9, dice.point(10), normal, 1), {}};
    const IndexedTriangles mesh = triangulate_refined(polygon, 0.3);
    const Quality q = measure(mesh, normal);
    EXPECT_NEAR(q.area, area(polygon), 1e-11);
    EXPECT_LE(q.longest, 0.3 * (1 + 1e-12));
    for (const Vec3& corner : polygon.outer)  // bit by bit
      EXPECT_NE(std::find(mesh.vertices.begin(), mesh.vertices.end(), corner), mesh.vertices.end());
  }
}

TEST(Refine, new_vertices_lie_in_the_plane_of_an_axis_parallel_polygon_to_the_last_bit) {
  const IndexedTriangles mesh = triangulate_refined({rectangle(0, 0, 1.7, 1.3, 2.7), {}}, 0.2);
  for (const Vec3& x : mesh.vertices) EXPECT_EQ(x.z(), 2.7);
}

TEST(Refine, the_same_polygon_gives_the_same_triangles) {
  const PlanarPolygon polygon{rectangle(0, 0, 5, 4), {rectangle(1, 1, 2, 3)}};
  const IndexedTriangles first = triangulate_refined(polygon, 0.3);
  std::vector<std::unique_ptr<char[]>> clutter;  // other addresses, which must not matter
  for (std::size_t k = 1; k < 200; ++k) clutter.push_back(std::make_unique<char[]>(k * 37));
  const IndexedTriangles second = triangulate_refined(polygon, 0.3);
  EXPECT_EQ(first.vertices, second.vertices);
  EXPECT_EQ(first.triangles, second.triangles);
}

}  // namespace
}  // namespace interflect::geometry

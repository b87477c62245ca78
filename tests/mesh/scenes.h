#pragma once

#include <map>

#include "mesh/uniform.h"
#include "tests/support/shapes.h"

namespace interflect::mesh {

using Triangles = std::vector<geometry::TriangleCorners>;

inline geometry::Ring ring_at(double scale, std::initializer_list<Vec3> corners) {
  geometry::Ring ring;
  for (const Vec3& corner : corners) ring.push_back(scale * corner);
  return ring;
}

/// An L with a square hole in its corner, in a plane that no axis is parallel to.
inline geometry::PlanarPolygon l_with_hole(double scale) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  const auto at = [&](double x, double y) -> Vec3 { return turn * Vec3(x, y, 0.3); };
  return {ring_at(scale, {at(0, 0), at(4, 0), at(4, 1.5), at(1.5, 1.5), at(1.5, 3), at(0, 3)}),
          {ring_at(scale, {at(0.5, 0.5), at(0.5, 1), at(1, 1), at(1, 0.5)})}};
}

inline scene::Material material(scene::Sides sides = scene::Sides::front) {
  return {"m", Spectrum(0.5), Spectrum(), sides};
}

/// A room of 5 x 4 x 3 with a box, a trapezoid, an L with a hole and an icosphere in it, two of them two-sided.
inline scene::Scene mixed_scene(double scale = 1) {
  scene::SceneBuilder builder({"grey"});
  const auto one = builder.add_material(material()), two = builder.add_material(material(scene::Sides::both));
  builder.add_box("room", {Vec3::Zero(), scale * Vec3(5, 4, 3)}, one, scene::SceneBuilder::Facing::inward);
  builder.add_box("desk", {scale * Vec3(1, 1, 0), scale * Vec3(2, 1.7, 0.7)}, one);
  builder.add_polygon("screen", {ring_at(scale, {{3, 1, 1}, {4, 1, 1}, {3.7, 1, 2.2}, {3.1, 1, 1.9}}), {}}, two);
  builder.add_polygon("shelf", l_with_hole(0.3 * scale), two);
  builder.add_facets("lamp", test::icosphere(1, 0.4 * scale, false), one);
  return builder.finish();
}

struct BitwiseLess {
  bool operator()(const Vec3& a, const Vec3& b) const {
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
  }
};

/// How many elements of a part run along each directed edge, end points told apart bit by bit.
using DirectedEdges = std::map<std::pair<std::uint32_t, std::uint32_t>, int>;
struct EdgeCensus {
  std::map<Vec3, std::uint32_t, BitwiseLess> vertices;
  std::vector<Vec3> position;
  DirectedEdges edges;

  EdgeCensus(const ElementMesh& mesh, const ElementMesh::Part& part) {
    for (const auto& patch : mesh.patches().subspan(part.first, part.count))
      for (std::size_t k = 0; k < patch.corners; ++k)
        ++edges[{vertex(patch.corner[k]), vertex(patch.corner[(k + 1) % patch.corners])}];
  }
  std::uint32_t vertex(const Vec3& x) {
    const auto [at, fresh] = vertices.try_emplace(x, static_cast<std::uint32_t>(position.size()));
    if (fresh) position.push_back(x);
    return at->second;
  }
  /// Edges without a partner in the opposite direction: those of the part's boundary, if it is conforming.
  std::vector<std::pair<Vec3, Vec3>> open() const {
    std::vector<std::pair<Vec3, Vec3>> result;
    for (const auto& [edge, count] : edges)
      if (!edges.contains({edge.second, edge.first})) result.emplace_back(position[edge.first], position[edge.second]);
    return result;
  }
};

inline double longest_edge(const ElementMesh& mesh) {
  double longest = 0;
  for (const auto& patch : mesh.patches())
    for (std::size_t k = 0; k < patch.corners; ++k)
      longest = std::max(longest, (patch.corner[(k + 1) % patch.corners] - patch.corner[k]).norm());
  return longest;
}

inline double smallest_angle_deg(const scene::SurfacePatch& patch) {
  double smallest = pi;
  for (std::size_t k = 0; k < patch.corners; ++k) {
    const Vec3 a = patch.corner[(k + 1) % patch.corners] - patch.corner[k];
    const Vec3 b = patch.corner[(k + patch.corners - 1) % patch.corners] - patch.corner[k];
    smallest = std::min(smallest, std::atan2(a.cross(b).norm(), a.dot(b)));
  }
  return smallest * 180 / pi;
}

}  // namespace interflect::mesh

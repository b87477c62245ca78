#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "mesh/element_mesh.h"

namespace interflect::mesh {

/// Elements as quadratic triangles, for looking: what is given at their points is continuous over each side of a
/// surface, but for its sharp edges.
///
/// A fan about an element's centroid goes through its corners and through all that hang on its edges, so that both
/// sides of an edge have the same points, and no cracks.
struct SmoothMesh {
  using Triangle = std::array<std::uint32_t, 6>;  ///< points: three corners, then the middles of 01, 12 and 20

  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> element;              ///< of each triangle
  std::vector<std::vector<std::uint32_t>> around;  ///< elements that share each point, ascending
};

/// Elements of one side of a surface whose normals differ by more than 20 degrees share no points.  Edges may have been
/// halved on one side, any number of times.
SmoothMesh smooth_mesh(const ElementMesh& mesh);

/// At each point the mean of what its elements say.
/// @param value  (element, point of it)
template <class Value>
std::vector<Value> smoothed(const SmoothMesh& smooth, const std::function<Value(std::uint32_t, const Vec3&)>& value) {
  std::vector<Value> out;
  out.reserve(smooth.points.size());
  for (std::size_t p = 0; p < smooth.points.size(); ++p) {
    Value sum = value(smooth.around[p].front(), smooth.points[p]);
    for (std::size_t k = 1; k < smooth.around[p].size(); ++k) sum += value(smooth.around[p][k], smooth.points[p]);
    out.push_back(sum / static_cast<double>(smooth.around[p].size()));
  }
  return out;
}

}  // namespace interflect::mesh

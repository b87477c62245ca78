#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/element_mesh.h"

namespace interflect::mesh {

/// The corners of elements as a continuous, piecewise linear function knows them.
///
/// Elements of one side of a surface share corners (shared_points.h).  A corner that hangs on a neighbour's edge, where
/// that was halved on one side only, has the mean of the edge's ends: it is no corner of its own.
struct SharedCorners {
  /// A value at a place is a mean of values at corners.
  struct Part {
    std::uint32_t corner;
    double weight;
  };
  using Mean = std::vector<Part>;  ///< by corner, ascending; weights sum to 1

  std::vector<Vec3> position;           ///< of those that do not hang
  std::vector<std::uint32_t> element;   ///< one that has it
  std::vector<std::array<Mean, 4>> of;  ///< of each element's corners
};

SharedCorners shared_corners(const ElementMesh& mesh);

}  // namespace interflect::mesh

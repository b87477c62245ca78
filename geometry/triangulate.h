#pragma once

#include <array>
#include <vector>

#include "geometry/polygon.h"

namespace interflect::geometry {

using TriangleCorners = std::array<Vec3, 3>;

/// The polygon as triangles that keep its orientation: constrained Delaunay triangulation of its rings, exact
/// predicates. Corners are those of the polygon, bit by bit.  Throws Defect as `require_valid` does.
std::vector<TriangleCorners> triangulate(const PlanarPolygon& polygon);

/// The face of a mesh as triangles: it need not be quite planar, and may touch itself (holes that a double edge joins
/// to the outline, as modellers write them), for it is cut along its shadow.  Throws Defect where that crosses itself
/// or has no area.
std::vector<TriangleCorners> triangulate_face(std::span<const Vec3> ring);

/// The polygon as well-shaped triangles whose edges are at most `max_edge` long [m]: Delaunay refinement ([Ruppert
/// 1995], angles above 20 degrees save where the polygon's own are smaller).  Indexed, conforming.
struct IndexedTriangles {
  std::vector<Vec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};
IndexedTriangles triangulate_refined(const PlanarPolygon& polygon, double max_edge);

}  // namespace interflect::geometry

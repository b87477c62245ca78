#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "fem/bounds/facet_cells.h"
#include "geometry/box_tree.h"
#include "scene/scene.h"

namespace interflect::fem {

/// A scene's facets as cells, about its centre and in units of its size, so that tolerances are numbers.
struct SceneCells {
  Vec3 centre;                              ///< of the scene [m]
  double size;                              ///< of the scene [m]
  double tolerance;                         ///< as near counts as the same edge: 1e-9, or what coordinates resolve
  double rounding;                          ///< of coordinates
  std::vector<std::array<Vec3, 3>> facets;  ///< their corners
  std::vector<FacetCell> cells;             ///< by facet, ascending
  geometry::BoxTree tree;                   ///< of cells

  Vec3 inside(const Vec3& x) const { return (x - centre) / size; }
  Vec3 outside(const Vec3& x) const { return centre + size * x; }
};

/// Nothing where there would be too many.
std::optional<SceneCells> scene_cells(const scene::Scene& scene);

Vec3 middle_of(const FacetCell& cell);
/// The least distance of a point of its plane from the edges of a convex polygon, counter-clockwise around its normal;
/// negative outside.
double depth_in(std::span<const Vec3> ring, const Vec3& normal, const Vec3& x);
/// Whether two planes count as parallel.
bool are_parallel(const Vec3& normal, const Vec3& other);

}  // namespace interflect::fem

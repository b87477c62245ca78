#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/box_grid.h"
#include "mesh/element_mesh.h"

namespace interflect::fem {

/// From what a ray hits to the element there: the answer of `mesh::ElementMesh::locate`, some twenty times sooner,
/// since it asks only those elements in whose boxes the point lies, and of them only whether they hold it.  Where
/// rounding lets none do so, `locate` is asked.
class ElementLocator {
 public:
  static constexpr Index none = -1;

  /// @param patches  surface after surface, fronts before backs, as meshes list them
  explicit ElementLocator(std::span<const scene::SurfacePatch> patches);

  /// The element that holds a point of a side of a surface; `none` where that side has no elements.
  Index operator()(const scene::SurfacePoint& point) const;

 private:
  /// The planes through an element and, across it, through its edges.
  struct Outline {
    Vec3 corner, normal;
    std::array<Vec3, 4> inwards;  ///< zero for what is not an edge
    std::array<double, 4> offset;
    double thickness;  ///< how far off its plane a point may be found on it [m]

    /// Whether what is d from the corner is on the inner side of all edges.
    bool holds(const Vec3& d) const {
      bool all = true;
      for (std::size_t k = 0; k < 4; ++k) all &= !(inwards[k].dot(d) < offset[k]);
      return all;
    }
  };
  static Outline outline_of(const scene::SurfacePatch& patch);

  mesh::ElementMesh mesh_;
  std::vector<Outline> outlines_;
  std::vector<geometry::BoxGrid> grids_;  ///< of the mesh's parts
  std::vector<std::int32_t> part_;        ///< by surface and side; -1: it has none
};

}  // namespace interflect::fem

#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "fem/form_factor/plane_outlines.h"
#include "geometry/box_grid.h"
#include "mesh/element_mesh.h"

namespace interflect::fem {

/// From what a ray hits to the element there: the answer of `mesh::ElementMesh::locate`, some twenty times sooner,
/// since it asks what likely holds the point (plane_outlines.h), then those elements in whose boxes it lies, and of them
/// only whether they hold it.  Where rounding lets none do so, `locate` is asked.
class ElementLocator {
 public:
  static constexpr Index none = -1;

  /// @param patches  surface after surface, fronts before backs, as meshes list them
  explicit ElementLocator(std::span<const scene::SurfacePatch> patches);

  /// The element that holds a point of a side of a surface; `none` where that side has no elements.
  Index operator()(const scene::SurfacePoint& point) const;
  /// Of many, `none` where there is no point: several times sooner, since their memory is waited for together.
  /// @param elements  overwritten; as many as points
  void operator()(std::span<const std::optional<scene::SurfacePoint>> points, std::span<Index> elements) const;

 private:
  /// The elements of a side of a surface.
  struct Part {
    Index first;  ///< in the mesh
    geometry::BoxGrid grid;
    PlaneOutlines outlines;
  };
  /// The elements that likely hold a point, where that can be told in the plane of all.
  struct Guess {
    const Part* part = nullptr;  ///< null: the side has no elements
    const PlaneOutlines::Likely* items = nullptr;
    Eigen::Vector2f in_plane = Eigen::Vector2f::Zero();
  };
  /// The planes through an element and, across it, through its edges.
  struct Outline {
    Vec3 corner, normal;
    std::array<Vec3, 4> inwards;  ///< zero for what is not an edge, its offset below all
    std::array<double, 4> offset;
    double thickness;  ///< how far off its plane a point may be found on it [m]
    double rim;        ///< no less than `inside` of what lies `thickness` from an edge [m²]

    /// How far on the inner side of all edges that is which lies d from the corner, times an edge's length [m²].
    double inside(const Vec3& d) const {
      double least = inwards[0].dot(d) - offset[0];
      for (std::size_t k = 1; k < 4; ++k) least = std::min(least, inwards[k].dot(d) - offset[k]);
      return least;
    }
  };
  static Outline outline_of(const scene::SurfacePatch& patch);
  Guess guess(const scene::SurfacePoint& point) const;
  Index by(const Guess& guess, const scene::SurfacePoint& point) const;
  static Index sure_among(const Guess& guess, std::span<const std::uint32_t> items);
  Index among_near(const Guess& guess, const scene::SurfacePoint& point) const;
  Index nearest_among(const Part& part, std::span<const std::uint32_t> items, const scene::SurfacePoint& point) const;

  mesh::ElementMesh mesh_;
  std::vector<Outline> outlines_;
  std::vector<Part> parts_;
  std::vector<std::int32_t> part_of_;  ///< by surface and side; -1: it has none
};

}  // namespace interflect::fem

#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/run.h"
#include "core/strong_id.h"
#include "geometry/box_tree.h"
#include "scene/scene.h"

/// Surfaces cut into elements.
namespace interflect::mesh {

using ElementId = StrongId<struct ElementTag>;

/// A place in an element; (u, v) are its own coordinates: barycentric on triangles, bilinear in [0,1]² on quads.
struct ElementPoint {
  ElementId element;
  double u = 0, v = 0;
};

/// The elements of a scene: of every active side of every surface, in the order of the surfaces, fronts before backs.
///
/// As meshes are made, they are conforming inside a side of a surface: two elements meet in a whole edge, a corner, or
/// not at all.  Where some are cut further (uniform.h), corners may hang on edges of their neighbours.
class ElementMesh {
 public:
  /// Elements of one side of one surface, which follow each other.
  struct Part {
    scene::SurfaceId surface;
    scene::Side side;
    std::uint32_t first, count;
  };

  /// @param patches  grouped by (surface, side), as described above
  /// @throws core::InputError  where an element has no area, in one line with its place
  explicit ElementMesh(std::vector<scene::SurfacePatch> patches);

  Index size() const { return static_cast<Index>(patches_.size()); }
  std::span<const scene::SurfacePatch> patches() const { return patches_; }
  const scene::SurfacePatch& patch(ElementId id) const { return patches_[id.value]; }
  std::span<const Part> parts() const { return parts_; }
  double longest_edge() const { return longest_edge_; }  ///< [m]

  /// The element that holds a point of a surface; nothing where that side has none.  Points on an edge belong to one of
  /// its elements, and rounding never loses a point of the surface (the nearest element is taken).
  std::optional<ElementPoint> locate(const scene::SurfacePoint& point) const;

 private:
  std::vector<scene::SurfacePatch> patches_;
  std::vector<Part> parts_;
  std::vector<geometry::BoxTree> trees_;  ///< per part, over its elements
  double longest_edge_ = 0;
};

double longest_edge(const scene::SurfacePatch& patch);  ///< [m]

/// Coordinates of a point of an element's plane: clamped into the element.
ElementPoint coordinates_in(const scene::SurfacePatch& patch, ElementId id, const Vec3& position);

}  // namespace interflect::mesh

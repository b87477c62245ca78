#pragma once

#include <cstdint>
#include <vector>

#include "fem/form_factor/element_shapes.h"
#include "fem/form_factor/eye.h"
#include "scene/scene.h"

namespace interflect::fem {

/// A convex polygon that fronts an eye, in the eye's local coordinates.
struct FrontingPolygon {
  std::array<Vec3, 4> corner;
  std::size_t corners;
  geometry::Plane plane;
  Vec3 centroid;
  Index shape;  ///< in ViewScene

  std::span<const Vec3> ring() const { return {corner.data(), corners}; }
};

/// All that an eye can see, as polygons that are seen from their fronts alone: the elements, and where a side of a
/// surface is not tiled by elements (black backs, surfaces without elements), its facets.
///
/// So what blocks is the scene's facets, to the last one; and no element lies in the plane of a facet that is drawn
/// with it, but on surfaces that elements cover in part.
class ViewScene {
 public:
  ViewScene(const scene::Scene& scene, std::span<const scene::SurfacePatch> patches, const ElementShapes& elements);

  Index elements() const { return elements_; }
  Index size() const { return static_cast<Index>(shapes_.size()); }
  bool is_element(Index shape) const { return shape < elements_; }
  const ElementShape& operator[](Index shape) const { return shapes_[static_cast<std::size_t>(shape)]; }

  /// The shape as seen from an element's side; false where it is seen from behind or edge-on, or lies below the
  /// horizon.  What is as near to a plane as rounding goes lies in it.
  bool fronting(const Eye& eye, Index element, Index shape, FrontingPolygon& polygon) const;

 private:
  const ElementShapes& rounding_;
  Index elements_;
  std::vector<ElementShape> shapes_;  ///< elements first, then bare facets; relative to the elements' origin
};

}  // namespace interflect::fem

#include "fem/form_factor/view_scene.h"

#include <algorithm>
#include <cmath>

namespace interflect::fem {

namespace {

constexpr double covered_part = 1 - 1e-9;  ///< of a side's area: then elements tile it

/// Areas that elements cover of each surface's two sides [m²].
std::vector<std::array<double, 2>> covered_areas(const scene::Scene& scene,
                                                 std::span<const scene::SurfacePatch> patches) {
  std::vector<std::array<double, 2>> areas(scene.surfaces.size(), {0, 0});
  for (const scene::SurfacePatch& patch : patches)
    if (patch.surface.value < areas.size()) areas[patch.surface.value][patch.side == scene::Side::back] += patch.area;
  return areas;
}

}  // namespace

ViewScene::ViewScene(const scene::Scene& scene, std::span<const scene::SurfacePatch> patches,
                     const ElementShapes& elements)
    : rounding_(elements), elements_(static_cast<Index>(patches.size())) {
  for (Index k = 0; k < elements_; ++k) shapes_.push_back(elements[k]);
  const auto covered = covered_areas(scene, patches);
  std::vector<double> areas(scene.surfaces.size(), 0);
  for (const scene::Facet& facet : scene.facets) areas[facet.surface.value] += facet.area;
  for (const scene::Facet& facet : scene.facets) {
    if (!(facet.area > 0)) continue;
    std::array<Vec3, 3> ring;
    for (std::size_t k = 0; k < 3; ++k) ring[k] = facet.corner[k] - elements.origin();
    geometry::Plane plane{facet.normal, facet.normal.dot(ring[0])};
    for (const bool back : {false, true}) {
      if (covered[facet.surface.value][back] < covered_part * areas[facet.surface.value])
        shapes_.push_back(shape_of(ring, plane));
      std::swap(ring[1], ring[2]);
      plane = {-plane.normal, -plane.offset};
    }
  }
}

bool ViewScene::fronting(const Eye& eye, Index element, Index shape, FrontingPolygon& polygon) const {
  const ElementShape &from = (*this)[element], &seen = (*this)[shape];
  if (seen.plane.distance(eye.position) <= rounding_.height_tolerance(seen, eye.position)) return false;
  double highest = 0;
  for (std::size_t k = 0; k < seen.corners; ++k) {
    polygon.corner[k] = eye.local(seen.corner[k]);
    highest = std::max(highest, polygon.corner[k].z());
  }
  if (highest <= 0 || highest <= rounding_.height_tolerance(from, seen.centroid)) return false;
  polygon.corners = seen.corners;
  polygon.plane = eye.local(seen.plane);
  polygon.centroid = eye.local(seen.centroid);
  polygon.shape = shape;
  return true;
}

}  // namespace interflect::fem

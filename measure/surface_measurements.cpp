#include "measure/surface_measurements.h"

namespace interflect::measure {

std::vector<scene::SurfacePatch> patches_of(const scene::Scene& scene, scene::SurfaceId surface, scene::Side side) {
  std::vector<scene::SurfacePatch> patches;
  for (const scene::Facet& facet : scene.facets_of(surface)) {
    const auto& [a, b, c] = facet.corner;
    const std::array<Vec3, 3> ring = side == scene::Side::front ? std::array{a, b, c} : std::array{a, c, b};
    patches.push_back(scene::make_patch(surface, side, ring));
  }
  return patches;
}

}  // namespace interflect::measure

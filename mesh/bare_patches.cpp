#include "mesh/bare_patches.h"

namespace interflect::mesh {
namespace {

using scene::Side;

/// By surface, whether any of its sides has elements.
std::vector<bool> meshed(const scene::Scene& scene, const ElementMesh& mesh) {
  std::vector<bool> has(scene.surfaces.size(), false);
  for (const ElementMesh::Part& part : mesh.parts()) has[part.surface.value] = true;
  return has;
}

}  // namespace

std::vector<scene::SurfacePatch> bare_patches(const scene::Scene& scene, const ElementMesh& mesh) {
  const std::vector<bool> has_elements = meshed(scene, mesh);
  std::vector<scene::SurfacePatch> bare;
  for (const scene::SurfaceId id : scene.surface_ids()) {
    if (has_elements[id.value]) continue;
    for (const Side side : {Side::front, Side::back}) {
      if (!scene.material(id).active(side)) continue;
      for (const scene::Facet& facet : scene.facets_of(id)) {
        const auto& [a, b, c] = facet.corner;
        const auto ring = side == Side::front ? std::array{a, b, c} : std::array{c, b, a};
        if (const scene::SurfacePatch patch = make_patch(id, side, ring); patch.area > 0) bare.push_back(patch);
      }
    }
  }
  return bare;
}

}  // namespace interflect::mesh

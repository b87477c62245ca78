#include "results/factors.h"

#include "results/digest.h"

namespace interflect::results {

FactorElements factor_elements(const scene::Scene& scene, std::span<const scene::SurfacePatch> patches) {
  FactorElements out;
  for (const scene::SurfacePatch& patch : patches) {
    out.area.push_back(patch.area);
    out.normal.push_back(patch.normal());
    out.centroid.push_back(patch.centroid());
    out.name.push_back(scene.side_name(patch.surface, patch.side));
  }
  return out;
}

std::string geometry_digest(const scene::Scene& scene, std::span<const scene::SurfacePatch> patches) {
  Digest digest;
  digest.add(scene.facets.size());
  for (const scene::Facet& facet : scene.facets)
    for (const Vec3& corner : facet.corner) digest.add(corner);
  digest.add(patches.size());
  for (const scene::SurfacePatch& patch : patches) {
    digest.add(patch.corners | std::uint64_t{patch.side == scene::Side::back} << 8);
    for (const Vec3& corner : patch.ring()) digest.add(corner);
  }
  return digest.text();
}

}  // namespace interflect::results

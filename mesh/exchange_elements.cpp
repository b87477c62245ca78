#include "mesh/exchange_elements.h"

#include <algorithm>

namespace interflect::mesh {

namespace {

bool radiates(const scene::ExchangeScene& geometry, scene::SurfaceId id) {
  return geometry.surfaces.empty() || geometry.surfaces[id.value].role == scene::ExchangeRole::radiates;
}

void add_covered(ExchangeElements& out, const scene::ExchangeScene& geometry, scene::SurfacePatch piece) {
  const std::uint32_t mask = piece.surface.value;
  const scene::SurfaceId base = geometry.masks[mask].base;
  if (!radiates(geometry, base)) return;
  piece.surface = base;
  scene::SurfacePatch covered = piece;
  std::swap(covered.corner[1], covered.corner[covered.corners - 1u]);
  out.patches.push_back(covered);
  out.patches.push_back(piece);
  out.mask.push_back(mask);
}

}  // namespace

ExchangeElements exchange_elements(const scene::ExchangeScene& geometry,
                                   const std::function<ElementMesh(const scene::Scene&)>& cut) {
  ExchangeElements out;
  const ElementMesh open = cut(geometry.scene);
  for (const scene::SurfacePatch& patch : open.patches())
    if (radiates(geometry, patch.surface)) out.patches.push_back(patch);
  out.open = out.patches.size();
  if (geometry.masks.empty()) return out;
  const ElementMesh masks = cut(scene::scene_of_masks(geometry));
  for (const scene::SurfacePatch& piece : masks.patches()) add_covered(out, geometry, piece);
  out.masks_left_out = static_cast<std::size_t>(
      std::count_if(geometry.masks.begin(), geometry.masks.end(),
                    [&](const scene::ExchangeMask& mask) { return !radiates(geometry, mask.base); }));
  return out;
}

}  // namespace interflect::mesh

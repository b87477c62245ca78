#include "visual/bare_surfaces.h"

#include <algorithm>

#include "mesh/bare_patches.h"
#include "visual/hatching.h"

namespace interflect::visual {
namespace {

constexpr std::uint32_t most_materials = 1000;  ///< of more materials some share a number

bool is_clear(const scene::Material& material) {
  return material.opacity < 1 || std::holds_alternative<scene::Pane>(material.finish) ||
         std::holds_alternative<scene::Glass>(material.finish);
}

}  // namespace

BareSurfaces bare_surfaces(const scene::Scene& scene, const mesh::ElementMesh& mesh) {
  BareSurfaces bare{mesh::bare_patches(scene, mesh), {}, {}, 0, {}};
  for (const scene::SurfacePatch& patch : bare.patches) {
    const scene::Material& material = scene.material(patch.surface);
    const bool clear = is_clear(material);
    const std::uint32_t face = hatching::face_of(scene.surface(patch.surface).material.value % most_materials, clear);
    const std::array<results::Colour, 4> same{hatching::ground, hatching::ground, hatching::ground, hatching::ground};
    Layer& layer = clear ? bare.clear : bare.opaque;
    layer.polygons.add(patch.ring(), std::span(same).first(patch.corners));
    layer.faces.push_back(face);
    bare.faces = std::max(bare.faces, face);
    const std::string kind = scene::type_of(material.finish);
    if (std::ranges::find(bare.kinds, kind) == bare.kinds.end()) bare.kinds.push_back(kind);
  }
  return bare;
}

std::string note_of(const BareSurfaces& bare) {
  std::string kinds;
  for (const std::string& kind : bare.kinds) kinds += (kinds.empty() ? "" : ", ") + kind;
  return "hatched: no elements (" + kinds + ")";
}

}  // namespace interflect::visual

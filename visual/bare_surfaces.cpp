#include "visual/bare_surfaces.h"

#include <algorithm>
#include <array>
#include <map>

#include "core/disjoint_sets.h"
#include "mesh/bare_patches.h"
#include "visual/hatching.h"

namespace interflect::visual {
namespace {

constexpr std::uint32_t most_materials = 1000;  ///< of more materials some share a number

bool is_clear(const scene::Material& material) {
  return material.opacity < 1 || std::holds_alternative<scene::Pane>(material.finish) ||
         std::holds_alternative<scene::Glass>(material.finish);
}

/// Of one material, and over corners that they share.
std::vector<std::vector<std::size_t>> bodies_of(const scene::Scene& scene,
                                                std::span<const scene::SurfacePatch> patches) {
  core::DisjointSets sets(patches.size());
  std::map<std::array<double, 3>, std::vector<std::uint32_t>> around;
  for (std::uint32_t k = 0; k < patches.size(); ++k)
    for (const Vec3& p : patches[k].ring()) {
      std::vector<std::uint32_t>& there = around[{p.x(), p.y(), p.z()}];
      for (const std::uint32_t other : there)
        if (&scene.material(patches[k].surface) == &scene.material(patches[other].surface)) sets.join(k, other);
      there.push_back(k);
    }
  std::map<std::uint32_t, std::vector<std::size_t>> bodies;
  for (std::uint32_t k = 0; k < patches.size(); ++k) bodies[sets.of(k)].push_back(k);
  std::vector<std::vector<std::size_t>> out;
  for (auto& [least, body] : bodies) out.push_back(std::move(body));
  return out;
}

void add(Polygons& polygons, const scene::SurfacePatch& patch) {
  const std::array<results::Colour, 4> same{hatching::ground, hatching::ground, hatching::ground, hatching::ground};
  polygons.add(patch.ring(), std::span(same).first(patch.corners));
}

}  // namespace

BareSurfaces bare_surfaces(const scene::Scene& scene, const mesh::ElementMesh& mesh) {
  BareSurfaces bare{mesh::bare_patches(scene, mesh), {}, 0, {}, {}};
  std::vector<scene::SurfacePatch> clear;
  for (const scene::SurfacePatch& patch : bare.patches) {
    const scene::Material& material = scene.material(patch.surface);
    const std::string kind = scene::type_of(material.finish);
    if (std::ranges::find(bare.kinds, kind) == bare.kinds.end()) bare.kinds.push_back(kind);
    if (is_clear(material)) {
      clear.push_back(patch);
      continue;
    }
    const std::uint32_t face = 1 + scene.surface(patch.surface).material.value % most_materials;
    add(bare.opaque.polygons, patch);
    bare.opaque.faces.push_back(face);
    bare.faces = std::max(bare.faces, face);
  }
  for (const std::vector<std::size_t>& body : bodies_of(scene, clear)) {
    Polygons& polygons = bare.clear.emplace_back();
    for (const std::size_t k : body) add(polygons, clear[k]);
  }
  return bare;
}

std::string note_of(const BareSurfaces& bare) {
  std::string kinds;
  for (const std::string& kind : bare.kinds) kinds += (kinds.empty() ? "" : ", ") + kind;
  return "hatched: no elements (" + kinds + ")";
}

}  // namespace interflect::visual

#include "visual/faces.h"

#include <array>
#include <cmath>
#include <map>

#include "core/disjoint_sets.h"

namespace interflect::visual {

std::vector<std::uint32_t> faces_of(const scene::Scene& scene, const mesh::ElementMesh& mesh) {
  static const double nearly_flat = std::cos(pi / 9);
  const std::span<const scene::SurfacePatch> patches = mesh.patches();
  const auto alike = [&](const scene::SurfacePatch& a, const scene::SurfacePatch& b) {
    return &scene.material(a.surface) == &scene.material(b.surface) && a.side == b.side &&
           a.normal().dot(b.normal()) > nearly_flat;
  };
  core::DisjointSets sets(patches.size());
  std::map<std::array<double, 3>, std::vector<std::uint32_t>> around;
  for (std::uint32_t e = 0; e < patches.size(); ++e)
    for (const Vec3& p : patches[e].ring()) {
      std::vector<std::uint32_t>& there = around[{p.x(), p.y(), p.z()}];
      for (std::uint32_t other : there)
        if (alike(patches[e], patches[other])) sets.join(e, other);
      there.push_back(e);
    }
  std::vector<std::uint32_t> faces(patches.size());
  std::uint32_t next = 0;
  for (std::uint32_t e = 0; e < faces.size(); ++e) faces[e] = sets.of(e) == e ? next++ : faces[sets.of(e)];
  return faces;
}

}  // namespace interflect::visual

#include "visual/faces.h"

#include <array>
#include <cmath>
#include <map>
#include <numeric>

namespace interflect::visual {

namespace {

/// Disjoint sets, each named by its least member.
class Sets {
 public:
  explicit Sets(std::size_t n) : above_(n) { std::iota(above_.begin(), above_.end(), 0U); }
  std::uint32_t of(std::uint32_t i) {
    while (above_[i] != i) i = above_[i] = above_[above_[i]];
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = of(a), b = of(b);
    above_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> above_;
};

}  // namespace

std::vector<std::uint32_t> faces_of(const scene::Scene& scene, const mesh::ElementMesh& mesh) {
  static const double nearly_flat = std::cos(pi / 9);
  const std::span<const scene::SurfacePatch> patches = mesh.patches();
  const auto alike = [&](const scene::SurfacePatch& a, const scene::SurfacePatch& b) {
    return &scene.material(a.surface) == &scene.material(b.surface) && a.side == b.side &&
           a.normal().dot(b.normal()) > nearly_flat;
  };
  Sets sets(patches.size());
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

#include "fem/element_point.h"

namespace interflect::fem {

std::array<scene::SurfacePatch, 4> quarters_of(const scene::SurfacePatch& patch) {
  const auto& p = patch.corner;
  const auto mid = [&](std::size_t a, std::size_t b) -> Vec3 { return 0.5 * (p[a] + p[b]); };
  const auto part = [&](std::initializer_list<Vec3> ring) {
    return scene::make_patch(patch.surface, patch.side, std::span(ring.begin(), ring.size()));
  };
  if (patch.corners == 3) {
    const Vec3 ab = mid(0, 1), bc = mid(1, 2), ca = mid(2, 0);
    return {part({p[0], ab, ca}), part({ab, p[1], bc}), part({ca, bc, p[2]}), part({ab, bc, ca})};
  }
  const Vec3 ab = mid(0, 1), bc = mid(1, 2), cd = mid(2, 3), da = mid(3, 0), centre = 0.5 * (ab + cd);
  return {part({p[0], ab, centre, da}), part({ab, p[1], bc, centre}), part({centre, bc, p[2], cd}),
          part({da, centre, cd, p[3]})};
}

}  // namespace interflect::fem

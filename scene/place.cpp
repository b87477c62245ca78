#include "scene/place.h"

#include <cassert>

#include "geometry/polygon.h"

namespace interflect::scene {

Vec3 SurfacePatch::normal() const { return geometry::vector_area(ring()).normalized(); }

Vec3 SurfacePatch::centroid() const {
  Vec3 first = (corner[0] + corner[1] + corner[2]) / 3;
  if (corners == 3) return first;
  const Vec3 second = (corner[0] + corner[2] + corner[3]) / 3;
  const double a = (corner[1] - corner[0]).cross(corner[2] - corner[0]).norm();
  const double b = (corner[2] - corner[0]).cross(corner[3] - corner[0]).norm();
  return first + (second - first) * (b / (a + b));
}

SurfacePatch make_patch(SurfaceId surface, Side side, std::span<const Vec3> ring) {
  assert(ring.size() == 3 || ring.size() == 4);
  SurfacePatch patch{surface, side, static_cast<std::uint8_t>(ring.size()), {}, geometry::vector_area(ring).norm()};
  patch.corner.fill(Vec3::Zero());
  for (std::size_t k = 0; k < ring.size(); ++k) patch.corner[k] = ring[k];
  return patch;
}

std::array<std::array<Vec3, 4>, 4> quarters_of(std::span<const Vec3> ring) {
  assert(ring.size() == 3 || ring.size() == 4);
  const auto middle = [&](std::size_t i, std::size_t j) -> Vec3 { return 0.5 * (ring[i] + ring[j]); };
  const Vec3 m01 = middle(0, 1), m12 = middle(1, 2);
  if (ring.size() == 3) {
    const Vec3 m20 = middle(2, 0), none = Vec3::Zero();
    return {{{ring[0], m01, m20, none}, {m01, ring[1], m12, none}, {m20, m12, ring[2], none}, {m12, m20, m01, none}}};
  }
  const Vec3 m23 = middle(2, 3), m30 = middle(3, 0), centre = 0.5 * (m01 + m23);
  return {{{ring[0], m01, centre, m30},
           {m01, ring[1], m12, centre},
           {centre, m12, ring[2], m23},
           {m30, centre, m23, ring[3]}}};
}

std::array<SurfacePatch, 4> quarters_of(const SurfacePatch& patch) {
  const auto rings = quarters_of(patch.ring());
  const auto part = [&](std::size_t k) {
    return make_patch(patch.surface, patch.side, std::span(rings[k]).first(patch.corners));
  };
  return {part(0), part(1), part(2), part(3)};
}

}  // namespace interflect::scene

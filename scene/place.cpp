#include "scene/place.h"

#include <cassert>

#include "geometry/polygon.h"

namespace interflect::scene {

Vec3 SurfacePatch::normal() const { return geometry::vector_area(ring()).normalized(); }

Vec3 SurfacePatch::centroid() const {
  const Vec3 first = (corner[0] + corner[1] + corner[2]) / 3;
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

}  // namespace interflect::scene

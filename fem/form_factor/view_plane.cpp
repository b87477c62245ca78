#include "fem/form_factor/view_plane.h"

#include "geometry/clip.h"

namespace interflect::fem {

ViewPlane::ViewPlane(Axis right, Axis up, Axis forward, const Rectangle& r)
    : right_(right),
      up_(up),
      forward_(forward),
      rectangle_(r),
      pyramid_{
          geometry::Plane{{1, 0, -r.x_low}, 0}, {{-1, 0, r.x_high}, 0}, {{0, 1, -r.y_low}, 0}, {{0, -1, r.y_high}, 0}} {
}

ViewPlane ViewPlane::top(double half_side) {
  return {{0, 1}, {1, 1}, {2, 1}, {-half_side, half_side, -half_side, half_side}};
}

ViewPlane ViewPlane::side(int k, double height) {
  constexpr Axis around[] = {{0, 1}, {1, 1}, {0, -1}, {1, -1}};
  return {around[(k + 1) % 4], {2, 1}, around[k % 4], {-1, 1, 0, height}};
}

ProjectedPolygon ViewPlane::project(std::span<const Vec3> ring, const geometry::Plane& plane) const {
  ProjectedPolygon projected;
  if (plane.offset == 0) return projected;
  geometry::ConvexRing kept;
  for (const Vec3& corner : ring) kept.corner[static_cast<std::size_t>(kept.corners++)] = to_face(corner);
  std::array<bool, 4> cuts{};
  for (std::size_t k = 0; k < 4; ++k) {
    int behind = 0;
    for (const Vec3& corner : kept.ring()) behind += pyramid_[k].normal.dot(corner) < 0;
    if (behind == kept.corners) return projected;
    cuts[k] = behind > 0;
  }
  for (std::size_t k = 0; k < 4; ++k)
    if (cuts[k]) kept = geometry::clip(kept.ring(), pyramid_[k]);
  for (const Vec3& corner : kept.ring())
    if (!(corner.z() > 0))
      return projected;  // the eye itself: only of a polygon whose plane it lies in but for rounding
  for (int k = 0; k < kept.corners; ++k) {
    const Vec3& corner = kept.corner[static_cast<std::size_t>(k)];
    projected.x[static_cast<std::size_t>(k)] = corner.x() / corner.z();
    projected.y[static_cast<std::size_t>(k)] = corner.y() / corner.z();
  }
  projected.corners = kept.corners;
  const Vec3 nearness = to_face(plane.normal) / plane.offset;
  projected.qx = nearness.x(), projected.qy = nearness.y(), projected.q0 = nearness.z();
  return projected;
}

}  // namespace interflect::fem

#include "geometry/shaft.h"

#include <cassert>
#include <cmath>

namespace interflect::geometry {

Shaft::Shaft(std::span<const Vec3> a, std::span<const Vec3> b, double rounding) {
  assert(a.size() >= 3 && a.size() <= most_corners && b.size() >= 3 && b.size() <= most_corners);
  double largest = 0;
  for (const auto ring : {a, b})
    for (const Vec3& x : ring) {
      corner_[static_cast<std::size_t>(corners_++)] = x;
      largest = std::max({largest, std::abs(x.x()), std::abs(x.y()), std::abs(x.z())});
    }
  margin_ = std::max(rounding, 1e-12 * largest);
  const Vec3 normal_a = vector_area(a).normalized(), normal_b = vector_area(b).normalized();
  add_own_plane(a, normal_a);
  add_own_plane(b, normal_b);
  add_edge_planes(a, normal_a, b);
  add_edge_planes(b, normal_b, a);
}

void Shaft::add(const Vec3& normal, double offset) {
  sides_[static_cast<std::size_t>(planes_++)] = {normal, normal.cwiseAbs(), offset};
}

/// The half-space in front of a polygon, without its plane: the margin goes inwards.
void Shaft::add_own_plane(std::span<const Vec3> ring, const Vec3& normal) {
  double lowest = normal.dot(ring[0]);
  for (const Vec3& x : ring.subspan(1)) lowest = std::min(lowest, normal.dot(x));
  add(normal, lowest + margin_);
}

/// Through each edge, the plane that turns from the polygon's own towards its front until all of `other` is behind it.
void Shaft::add_edge_planes(std::span<const Vec3> ring, const Vec3& normal, std::span<const Vec3> other) {
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Vec3& from = ring[k];
    const Vec3 edge = ring[k + 1 < ring.size() ? k + 1 : 0] - from;
    const Vec3 inwards = normal.cross(edge);  // as long as the edge
    const double length = edge.norm();
    // Seen along the edge, a corner is at (p, q) = (inwards, in front); the greatest angle from +p supports.
    double p = 1, q = 0;
    for (const Vec3& x : other) {
      const Vec3 r = x - from;
      const double px = inwards.dot(r), qx = length * normal.dot(r);
      if (p * qx - q * px > 0) p = px, q = qx;
    }
    const Vec3 candidate = q * inwards - (p * length) * normal;
    const double size = candidate.norm();
    if (!(size > 0) || !std::isfinite(size)) continue;
    const Vec3 unit = candidate / size;
    double lowest = unit.dot(corner_[0]);
    for (const Vec3& x : corners().subspan(1)) lowest = std::min(lowest, unit.dot(x));
    add(unit, lowest - margin_);
  }
}

}  // namespace interflect::geometry

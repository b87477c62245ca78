#pragma once

#include <array>
#include <cassert>
#include <span>

#include "geometry/polygon.h"

namespace interflect::geometry {

/// A convex planar polygon of few corners, without a heap: what clipping in hot loops works on.
struct ConvexRing {
  static constexpr int capacity = 12;
  std::array<Vec3, capacity> corner;
  int corners = 0;  ///< 0 where nothing is left, else 3 or more

  std::span<const Vec3> ring() const { return {corner.data(), static_cast<std::size_t>(corners)}; }
};

/// The part of a convex polygon in front of a plane, its orientation kept.
///
/// A corner on the plane belongs to the front.  A new corner is computed from the front end of its edge, so that
/// neighbours that share the edge get the same bits.  A polygon that meets the closed front in an edge or a corner
/// alone leaves nothing.
/// @param ring  convex, at most ConvexRing::capacity - 1 corners
inline ConvexRing clip(std::span<const Vec3> ring, const Plane& plane) {
  assert(ring.size() < static_cast<std::size_t>(ConvexRing::capacity));
  ConvexRing kept;
  // Rounding may make a ring in the plane weave through it: never beyond the array.
  const auto keep = [&](const Vec3& x) {
    if (kept.corners < ConvexRing::capacity) kept.corner[static_cast<std::size_t>(kept.corners++)] = x;
  };
  if (ring.empty()) return kept;
  bool inner = false;  // a corner strictly in front
  const Vec3* from = &ring.back();
  double from_distance = plane.distance(*from);
  for (const Vec3& to : ring) {
    const double to_distance = plane.distance(to);
    if (from_distance > 0 && to_distance < 0)
      keep(*from + (from_distance / (from_distance - to_distance)) * (to - *from));
    else if (from_distance < 0 && to_distance > 0)
      keep(to + (to_distance / (to_distance - from_distance)) * (*from - to));
    if (to_distance >= 0) keep(to);
    inner |= to_distance > 0;
    from = &to;
    from_distance = to_distance;
  }
  if (!inner || kept.corners < 3) kept.corners = 0;
  return kept;
}

}  // namespace interflect::geometry

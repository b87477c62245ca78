#pragma once

#include <algorithm>
#include <array>
#include <span>

#include "geometry/box.h"
#include "geometry/convex_blocker.h"
#include "geometry/polygon.h"

namespace interflect::geometry {

/// The region in which something must lie to block light between two convex polygons: a superset of their convex hull's
/// part in front of both.
///
/// It is bounded by the planes of the two polygons and, for each edge of either, by the plane through that edge that
/// supports the other ([Haines, Wallace 1991] "Shaft culling for efficient ray-traced radiosity", with the hull itself
/// in place of boxes). Every plane is moved out until both polygons are inside, by their corners: whatever the
/// configuration (touching, coplanar, one reaching behind the other), a shaft may be too wide and never too narrow.
/// What lies in the plane of one of the polygons, or behind it, blocks nothing: light leaves to the front.
///
/// Rounding is covered by a margin of 1e-12 of the largest coordinate, or more where the caller knows of more: polygons
/// that were brought here from far away carry the rounding of their coordinates there.  No heap, and no division but in
/// plane normals.
class Shaft {
 public:
  static constexpr int most_corners = 6;  ///< of either polygon: a quad after two clips

  /// @param a, b      convex rings, 3 .. most_corners corners [m], counter-clockwise around the sides that exchange
  /// light
  /// @param rounding  of corners, theirs and the triangles' [m]
  Shaft(std::span<const Vec3> a, std::span<const Vec3> b, double rounding = 0);

  /// False only if no point of the triangle's interior can lie between the polygons.
  bool may_block(const Vec3& p, const Vec3& q, const Vec3& r) const {
    for (int k = 0; k < planes_; ++k) {
      const Side& side = sides_[static_cast<std::size_t>(k)];
      if (side.normal.dot(p) <= side.offset && side.normal.dot(q) <= side.offset && side.normal.dot(r) <= side.offset)
        return false;
    }
    return !leaves_hull_aside(p, q, r);
  }
  bool may_block(const std::array<Vec3, 3>& triangle) const { return may_block(triangle[0], triangle[1], triangle[2]); }

  /// The same for all of a convex blocker.
  bool may_block(const ConvexBlocker& blocker) const {
    for (int k = 0; k < planes_; ++k)
      if (outside(sides_[static_cast<std::size_t>(k)], blocker.corners())) return false;
    return std::none_of(blocker.planes().begin(), blocker.planes().end(),
                        [&](const Plane& face) { return hull_in_front(face); });
  }

  /// False only if nothing in the box can lie between the polygons.
  bool may_block(const Box& box) const {
    const Vec3 centre = box.center(), half = 0.5 * box.sizes();
    for (int k = 0; k < planes_; ++k) {
      const Side& side = sides_[static_cast<std::size_t>(k)];
      if (side.normal.dot(centre) + side.absolute.dot(half) <= side.offset) return false;
    }
    return true;
  }

  int planes() const { return planes_; }

 private:
  struct Side {
    Vec3 normal, absolute;  ///< unit, inwards; and its absolute values
    double offset;          ///< outside: normal . x <= offset
  };

  static bool outside(const Side& side, std::span<const Vec3> corners) {
    return std::all_of(corners.begin(), corners.end(),
                       [&](const Vec3& x) { return side.normal.dot(x) <= side.offset; });
  }
  bool hull_in_front(const Plane& face) const {
    for (int k = 0; k < corners_; ++k)
      if (face.distance(corner_[static_cast<std::size_t>(k)]) < -margin_) return false;
    return true;
  }

  void add_own_plane(std::span<const Vec3> ring, const Vec3& normal);
  void add_edge_planes(std::span<const Vec3> ring, const Vec3& normal, std::span<const Vec3> other);
  void add(const Vec3& normal, double offset);
  std::span<const Vec3> corners() const { return {corner_.data(), static_cast<std::size_t>(corners_)}; }

  /// Whether both polygons lie on one side of the triangle's plane (or in it).
  bool leaves_hull_aside(const Vec3& p, const Vec3& q, const Vec3& r) const {
    const Vec3 u = q - p, v = r - p, normal = u.cross(v);
    const double at_q = normal.dot(u), at_r = normal.dot(v);  // 0 but for rounding
    double lowest = normal.dot(corner_[0] - p), highest = lowest;
    for (int k = 1; k < corners_; ++k) {
      const double d = normal.dot(corner_[static_cast<std::size_t>(k)] - p);
      lowest = std::min(lowest, d);
      highest = std::max(highest, d);
    }
    const double margin = margin_ * normal.norm();
    return lowest >= std::max({0.0, at_q, at_r}) - margin || highest <= std::min({0.0, at_q, at_r}) + margin;
  }

  static constexpr int most_planes = 2 * most_corners + 2;
  std::array<Side, most_planes> sides_;
  std::array<Vec3, 2 * most_corners> corner_;
  int planes_ = 0, corners_ = 0;
  double margin_ = 0;  ///< [m]
};

/// What a shaft is made from where one end is a point: a triangle about it, across the normal, too small to matter; no
/// corner is farther than `size`.
inline std::array<Vec3, 3> speck(const Vec3& x, const Vec3& normal, double size) {
  const Vec3 u = normal.unitOrthogonal(), v = normal.cross(u);
  return {x + size * u, x + size * (-0.5 * u + 0.8 * v), x + size * (-0.5 * u - 0.8 * v)};
}

}  // namespace interflect::geometry

#pragma once

#include <cmath>

#include "core/hemisphere.h"
#include "geometry/polygon.h"

namespace interflect::fem {

/// From where, and turned how, a hemisphere is looked at; its frame's n is the zenith.
struct Eye {
  Vec3 position;      ///< [m]
  core::Frame frame;  ///< right-handed, of unit vectors

  /// Components along s, t, n of a position, relative to the eye [m].
  Vec3 local(const Vec3& x) const {
    const Vec3 r = x - position;
    return {r.dot(frame.s), r.dot(frame.t), r.dot(frame.n)};
  }
  geometry::Plane local(const geometry::Plane& plane) const {
    const Vec3& n = plane.normal;
    return {{n.dot(frame.s), n.dot(frame.t), n.dot(frame.n)}, -plane.distance(position)};
  }
};

/// @param azimuth  that s and t are turned by about n [rad]
inline Eye eye_at(const Vec3& position, const Vec3& n, double azimuth) {
  const core::Frame f = core::frame_around(n);
  const double c = std::cos(azimuth), s = std::sin(azimuth);
  return {position, {c * f.s + s * f.t, c * f.t - s * f.s, n}};
}

}  // namespace interflect::fem

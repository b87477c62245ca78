#pragma once

#include <cmath>

#include "core/hemisphere.h"

/// Directions uniform in a cone about +z, whose half angle m is told by k = 1 - cos m, so that small cones lose no
/// digits: k = 1 is the hemisphere, k = 2 the sphere.
///
///   1 - z = u k,   pdf_solid_angle = 1 / (2 pi k)
///
/// Round trip: 1e-12.  Test: tests/montecarlo/lights.cpp
namespace interflect::montecarlo {

inline double uniform_cone_pdf_solid_angle(double k) { return 1 / (2 * pi * k); }

inline Vec3 uniform_cone(double k, double u, double v) {
  double sine, cosine;
  core::sin_cos_turns(v, sine, cosine);
  const double below = u * k, r = std::sqrt(below * (2 - below));
  return {r * cosine, r * sine, 1 - below};
}

/// (u, v) of a direction.
inline Vec2 uniform_cone_inverse(double k, const Vec3& way) {
  const double sine2 = way.x() * way.x() + way.y() * way.y();
  const double below = way.z() > 0 ? sine2 / (1 + way.z()) : 1 - way.z();
  return {below / k, core::turns_about_z(way)};
}

}  // namespace interflect::montecarlo

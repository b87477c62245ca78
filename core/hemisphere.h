#pragma once

#include <cmath>

#include "core/vec.h"

/// Directions about a normal.
namespace interflect::core {

/// Two tangents and a unit normal, right-handed.
struct Frame {
  Vec3 s, t, n;
  Vec3 to_world(const Vec3& local) const { return local.x() * s + local.y() * t + local.z() * n; }
};

/// Source: [Duff et al. 2017] "Building an orthonormal basis, revisited", JCGT 6(1): no branch, no singular direction.
inline Frame frame_around(const Vec3& n) {
  const double sign = std::copysign(1.0, n.z());
  const double a = -1 / (sign + n.z()), b = n.x() * n.y() * a;
  return {{1 + sign * n.x() * n.x() * a, sign * b, -sign * n.x()}, {b, sign + n.y() * n.y() * a, -n.y()}, n};
}

/// A direction about +z with pdf_solid_angle = cos(theta) / pi [1/sr]; z > 0 always, for u < 1.  (Malley: a uniform
/// disk, lifted.)
inline Vec3 cosine_hemisphere(double u, double v) {
  const double r = std::sqrt(u), phi = 2 * pi * v;
  return {r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - u)};
}

/// A point of a triangle with pdf_area = 1 / area [Turk 1990].
inline Vec3 triangle_point(const Vec3& a, const Vec3& b, const Vec3& c, double u, double v) {
  const double s = std::sqrt(u);
  return a + s * (1 - v) * (b - a) + s * v * (c - a);
}

}  // namespace interflect::core

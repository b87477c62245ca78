#pragma once

#include <array>

#include "core/vec.h"

namespace interflect::montecarlo {

/// Directions uniform in the solid angle that a triangle fills: the area u Omega is cut off at corner a by a point c' of
/// the arc from a to c, and v divides the arc from b to c' by its cosine.
///
///   tan(Omega / 2) = a . (b x c) / (1 + a.b + b.c + c.a),   pdf_solid_angle = 1 / Omega
///
/// Accuracy: u to about 1e-15 / Omega.  Source: [Arvo 1995] "Stratified sampling of spherical triangles", but that the
/// arc b' from a to c' is told by its half, which loses no digits where it is short: from tan(E / 2) = t k sin(alpha) /
/// (1 + t k cos(alpha)) with t = tan(b' / 2), k = tan(ab / 2), alpha the angle at a and E = u Omega.  Omega by [Van
/// Oosterom and Strackee 1983].  Test: tests/montecarlo/lights.cpp
class SphericalTriangle {
 public:
  /// @param corner  unit vectors, in either orientation
  explicit SphericalTriangle(const std::array<Vec3, 3>& corner);

  double solid_angle() const { return solid_angle_; }  ///< [sr], 0 .. 2 pi
  Vec3 direction(double u, double v) const;
  Vec2 inverse(const Vec3& direction) const;

 private:
  Vec3 a_, b_, c_;
  double cos_alpha_, sin_alpha_, cos_ab_, sin_ab_, solid_angle_;
};

}  // namespace interflect::montecarlo

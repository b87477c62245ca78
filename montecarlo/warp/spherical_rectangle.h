#pragma once

#include <complex>

#include "core/vec.h"

namespace interflect::montecarlo {

/// Directions uniform in the solid angle that a rectangle fills: u Omega is cut off by a line across it, and v divides
/// that line by its sine.
///
///   Omega = g_0 + g_1 + g_2 + g_3 - 2 pi,   g: angles between neighbouring edges' planes;   pdf_solid_angle = 1 / Omega
///
/// The angles are kept as complex numbers of length 1, whose product needs one arctangent.
/// Accuracy: u to about 1e-15 / Omega.
/// Source: [Urena, Fajardo and King 2013] "An area-preserving parametrization for spherical rectangles".
/// Test: tests/montecarlo/lights.cpp
class SphericalRectangle {
 public:
  /// @param corner  of the rectangle
  /// @param x, y    unit, along the sides from that corner, perpendicular
  /// @param a, b    lengths of those sides [m]
  SphericalRectangle(const Vec3& from, const Vec3& corner, const Vec3& x, const Vec3& y, double a, double b);

  double solid_angle() const { return solid_angle_; }  ///< [sr], 0 .. 2 pi
  /// The point of the rectangle in that direction, as lengths along x and y from its corner.
  Vec2 point(double u, double v) const;
  Vec2 inverse(const Vec2& point) const;

 private:
  /// The part to the left of x, as a number of length 1 whose angle it is.
  std::complex<double> left_of(double x) const;

  double x0_, y0_, x1_, y1_, z_;  ///< in a frame about `from`, whose z leads away from the rectangle: z < 0
  std::complex<double> start_;    ///< e^(i k), k = 2 pi - g_2 - g_3
  double b0_, b1_;                ///< z of the planes' normals
  double solid_angle_;
};

}  // namespace interflect::montecarlo

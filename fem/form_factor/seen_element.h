#pragma once

#include <array>
#include <span>

#include "core/vec.h"

namespace interflect::fem {

/// A triangle as a point sees it, on the unit sphere.
class SeenTriangle {
 public:
  SeenTriangle() = default;
  /// @param eye      [m]
  /// @param a, b, c  corners [m], counter-clockwise as seen from the side that is looked for
  SeenTriangle(const Vec3& eye, const Vec3& a, const Vec3& b, const Vec3& c);

  /// [sr]; 0 from behind, and where rounding leaves nothing of it (below 1e-12).  Source: [van Oosterom, Strackee
  /// 1983].
  double solid_angle() const { return solid_angle_; }
  /// A direction uniform in solid angle, area onto area from (u, v) in [0, 1]²: only where the solid angle is not 0.
  /// Source: [Arvo 1995] "Stratified sampling of spherical triangles", SIGGRAPH 95, section 3.
  Vec3 direction(double u, double v) const;

 private:
  Vec3 a_, b_, c_;
  double solid_angle_ = 0, cos_alpha_ = 1, sin_alpha_ = 0;  ///< alpha: the angle at a
};

/// A triangle or convex quad as a point sees it.
class SeenElement {
 public:
  SeenElement(const Vec3& eye, std::span<const Vec3> ring);
  double solid_angle() const { return part_[0].solid_angle() + part_[1].solid_angle(); }
  Vec3 direction(double u, double v) const;

 private:
  std::array<SeenTriangle, 2> part_;
};

}  // namespace interflect::fem

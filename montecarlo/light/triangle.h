#pragma once

#include "montecarlo/light/diffuse_side.h"
#include "montecarlo/warp/spherical_triangle.h"

namespace interflect::montecarlo {

/// The front of a triangle that emits diffusely.
class TriangleLight final : public FlatLight<TriangleLight> {
 public:
  /// @param normal  unit: the way it shines
  TriangleLight(const std::array<Vec3, 3>& corner, const Vec3& normal, const Spectrum& exitance);

  LightExtent extent() const override;

  Vec3 point(double u, double v) const { return triangle_point(corner_[0], corner_[1], corner_[2], u, v); }
  SphericalTriangle seen_from(const Vec3& x) const;
  std::optional<Arriving> arriving_within(const SphericalTriangle& seen, const Vec3& x, double u, double v) const;

 private:
  std::array<Vec3, 3> corner_;
};

}  // namespace interflect::montecarlo

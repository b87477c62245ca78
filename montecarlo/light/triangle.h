#pragma once

#include "montecarlo/light/diffuse_side.h"
#include "montecarlo/warp/spherical_triangle.h"

namespace interflect::montecarlo {

/// The front of a triangle that emits diffusely.
class TriangleLight final : public DiffuseSide {
 public:
  /// @param normal  unit: the way it shines
  TriangleLight(const std::array<Vec3, 3>& corner, const Vec3& normal, const Spectrum& exitance);

  std::optional<Arriving> sample_arriving(const Place& at, double u, double v) const override;
  double pdf_arriving_solid_angle(const Place& at, const Vec3& way, const Vec3& position) const override;
  Emission sample_emission(const std::array<double, 4>& u) const override;
  LightExtent extent() const override;

 private:
  SphericalTriangle seen_from(const Vec3& x) const;

  std::array<Vec3, 3> corner_;
};

}  // namespace interflect::montecarlo

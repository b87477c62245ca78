#pragma once

#include <span>

#include "montecarlo/light/diffuse_side.h"
#include "montecarlo/warp/spherical_rectangle.h"

namespace interflect::montecarlo {

/// The front of a rectangle that emits diffusely.
class RectangleLight final : public DiffuseSide {
 public:
  /// @param corner  where u and v, perpendicular, begin
  /// @param normal  unit: the way it shines
  RectangleLight(const Vec3& corner, const Vec3& u, const Vec3& v, const Vec3& normal, const Spectrum& exitance);

  std::optional<Arriving> sample_arriving(const Place& at, double u, double v) const override;
  double pdf_arriving_solid_angle(const Place& at, const Vec3& way, const Vec3& position) const override;
  Emission sample_emission(const std::array<double, 4>& u) const override;
  LightExtent extent() const override;

 private:
  SphericalRectangle seen_from(const Vec3& x) const { return {x, corner_, x_, y_, a_, b_}; }

  Vec3 corner_, u_, v_;
  double a_, b_;  ///< lengths of the sides
  Vec3 x_, y_;    ///< unit, along them
};

/// Whether four corners in turn are those of a rectangle, within `angle` [rad] of right angles.
bool is_rectangle(std::span<const Vec3> ring, double angle = 1e-9);

}  // namespace interflect::montecarlo

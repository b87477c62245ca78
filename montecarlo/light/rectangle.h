#pragma once

#include <span>

#include "montecarlo/light/diffuse_side.h"
#include "montecarlo/warp/spherical_rectangle.h"

namespace interflect::montecarlo {

/// The front of a rectangle that emits diffusely.
class RectangleLight final : public FlatLight<RectangleLight> {
 public:
  /// @param corner  where u and v, perpendicular, begin
  /// @param normal  unit: the way it shines
  RectangleLight(const Vec3& corner, const Vec3& u, const Vec3& v, const Vec3& normal, const Spectrum& exitance);

  LightExtent extent() const override;

  Vec3 point(double u, double v) const { return corner_ + u * u_ + v * v_; }
  SphericalRectangle seen_from(const Vec3& x) const { return {x, corner_, x_, y_, a_, b_}; }
  std::optional<Arriving> arriving_within(const SphericalRectangle& seen, const Vec3& x, double u, double v) const;

 private:
  Vec3 corner_, u_, v_;
  double a_, b_;  ///< lengths of the sides
  Vec3 x_, y_;    ///< unit, along them
};

/// Whether four corners in turn are those of a rectangle, within `angle` [rad] of right angles.
bool is_rectangle(std::span<const Vec3> ring, double angle = 1e-9);

}  // namespace interflect::montecarlo

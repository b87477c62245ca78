#pragma once

#include "montecarlo/light/from_point.h"
#include "scene/light.h"

namespace interflect::montecarlo {

/// A point that shines into a cone (scene::SpotLight).  Ways are drawn in proportion to the intensity: with x = 1 - cos
/// of the angle with the axis, b and f of beam and field,
///
///   int_0^x I = 2 pi I x within the beam,   pi I (2 b + (f - b) (1 - (2 t³ - t⁴)))   between it and the field.
class Spot final : public LightFromPoint {
 public:
  explicit Spot(const scene::SpotLight& light);

  Spectrum flux() const override { return light_.flux(); }
  Emission sample_emission(const std::array<double, 4>& u) const override;
  EmissionPdfs pdfs_emission(const Vec3& position, const Vec3& way) const override;
  LightExtent extent() const override;

 private:
  double part_of_intensity(const Vec3& way) const override { return light_.falloff(way.dot(light_.direction)); }
  double below_one(double u) const;  ///< 1 - cosine of the way with the axis

  scene::SpotLight light_;
  double beam_, field_;  ///< 1 - cosine
};

}  // namespace interflect::montecarlo

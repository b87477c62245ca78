#pragma once

#include "montecarlo/light/light.h"
#include "scene/light.h"

namespace interflect::montecarlo {

/// A point that shines into a cone (scene::SpotLight).  Ways are drawn in proportion to the intensity: with x = 1 - cos
/// of the angle with the axis, b and f of beam and field,
///
///   int_0^x I = 2 pi I x within the beam,   pi I (2 b + (f - b) (1 - (2 t³ - t⁴)))   between it and the field.
class Spot final : public Light {
 public:
  explicit Spot(const scene::SpotLight& light);

  Spectrum flux() const override { return light_.flux(); }
  std::optional<Arriving> sample_arriving(const Place& at, double u, double v) const override;
  double pdf_arriving_solid_angle(const Place&, const Vec3&, const Vec3&) const override { return 0; }
  Emission sample_emission(const std::array<double, 4>& u) const override;
  EmissionPdfs pdfs_emission(const Vec3& position, const Vec3& way) const override;
  Spectrum radiance(const Vec3&, const Vec3&) const override { return Spectrum::zero(); }
  LargestFind largest_find(double from) const override {
    return {Spectrum(infinite), light_.intensity / (from * from)};
  }
  LightExtent extent() const override;
  bool is_delta_position() const override { return true; }

 private:
  double below_one(double u) const;  ///< 1 - cosine of the way with the axis

  scene::SpotLight light_;
  double beam_, field_;  ///< 1 - cosine
};

}  // namespace interflect::montecarlo

#pragma once

#include "montecarlo/light/light.h"
#include "scene/light.h"

namespace interflect::montecarlo {

/// Light from a point: H = I / d² perpendicular to the way.
class PointSource final : public Light {
 public:
  explicit PointSource(const scene::PointLight& light) : light_(light) {}

  Spectrum flux() const override { return light_.flux(); }
  std::optional<Arriving> sample_arriving(const Place& at, double u, double v) const override;
  double pdf_arriving_solid_angle(const Place&, const Vec3&, const Vec3&) const override { return 0; }
  Emission sample_emission(const std::array<double, 4>& u) const override;
  EmissionPdfs pdfs_emission(const Vec3&, const Vec3&) const override { return {1, inv_pi / 4}; }
  Spectrum radiance(const Vec3&, const Vec3&) const override { return Spectrum::zero(); }
  LargestFind largest_find(double from) const override {
    return {Spectrum(infinite), light_.intensity / (from * from)};
  }
  LightExtent extent() const override;
  bool is_delta_position() const override { return true; }

 private:
  scene::PointLight light_;
};

}  // namespace interflect::montecarlo

#pragma once

#include "montecarlo/light/from_point.h"
#include "scene/light.h"

namespace interflect::montecarlo {

/// One that shines alike everywhere.
class PointSource final : public LightFromPoint {
 public:
  explicit PointSource(const scene::PointLight& light)
      : LightFromPoint(light.position, light.intensity), light_(light) {}

  Spectrum flux() const override { return light_.flux(); }
  Emission sample_emission(const std::array<double, 4>& u) const override;
  EmissionPdfs pdfs_emission(const Vec3&, const Vec3&) const override { return {1, inv_pi / 4}; }
  LightExtent extent() const override;

 private:
  double part_of_intensity(const Vec3&) const override { return 1; }

  scene::PointLight light_;
};

}  // namespace interflect::montecarlo

#pragma once

#include "montecarlo/light/light.h"
#include "scene/light.h"

namespace interflect::montecarlo {

/// A ball that shines outwards (scene::SphereLight).  From outside, ways are drawn uniformly over the cone that it
/// fills, k = 1 - cos m = s² / (1 + cos m) with s = R / d; within it, it is dark.
class BallLight final : public Light {
 public:
  explicit BallLight(const scene::SphereLight& light) : light_(light) {}

  Spectrum flux() const override { return light_.flux(); }
  std::optional<Arriving> sample_arriving(const Place& at, double u, double v) const override;
  double pdf_arriving_solid_angle(const Place& at, const Vec3& way, const Vec3& position) const override;
  Emission sample_emission(const std::array<double, 4>& u) const override;
  EmissionPdfs pdfs_emission(const Vec3& position, const Vec3& way) const override;
  Spectrum radiance(const Vec3& position, const Vec3& way) const override;
  LargestFind largest_find(double) const override { return {light_.exitance, Spectrum(infinite)}; }
  LightExtent extent() const override;

 private:
  /// 1 - cos m from there; nothing from within.
  std::optional<double> cone_from(const Vec3& x) const;

  scene::SphereLight light_;
};

}  // namespace interflect::montecarlo

#pragma once

#include "montecarlo/light/afar.h"
#include "scene/light.h"

namespace interflect::montecarlo {

/// A disk far away (scene::Sun), drawn uniformly over its cone; parallel light where it has no size.
class SunLight final : public LightFromAfar {
 public:
  SunLight(const scene::Sun& sun, const geometry::Box& box);

  Spectrum flux() const override;
  std::optional<Arriving> sample_arriving(const Place& at, double u, double v) const override;
  double pdf_arriving_solid_angle(const Place& at, const Vec3& way, const Vec3& position) const override;
  Emission sample_emission(const std::array<double, 4>& u) const override;
  EmissionPdfs pdfs_emission(const Vec3& position, const Vec3& way) const override;
  Spectrum radiance(const Vec3& position, const Vec3& way) const override;
  LargestFind largest_find(double) const override {
    return {cone_ > 0 ? pi * radiance_ : Spectrum(infinite), perpendicular_};
  }
  bool is_delta_direction() const override { return cone_ == 0; }

 private:
  scene::Sun sun_;
  Frame towards_;           ///< about the way to its middle
  double cone_;             ///< 1 - cos alpha
  Spectrum radiance_;       ///< zero for parallel light
  Spectrum perpendicular_;  ///< int L d sigma = L Omega, little more than the irradiance
};

}  // namespace interflect::montecarlo

#pragma once

#include "montecarlo/light/afar.h"
#include "scene/light.h"

namespace interflect::montecarlo {

/// A uniform sky over a uniform ground (scene::Sky).  What arrives is drawn by the cosine with the receiver's normal,
/// or uniformly over the sphere where it has none; what leaves, uniformly over the hemispheres that shine.
class SkyLight final : public LightFromAfar {
 public:
  SkyLight(const scene::Sky& sky, const geometry::Box& box);

  Spectrum flux() const override { return disk_area() * 2 * pi * (sky_.radiance + sky_.ground); }
  std::optional<Arriving> sample_arriving(const Place& at, double u, double v) const override;
  double pdf_arriving_solid_angle(const Place& at, const Vec3& way, const Vec3& position) const override;
  Emission sample_emission(const std::array<double, 4>& u) const override;
  EmissionPdfs pdfs_emission(const Vec3& position, const Vec3& way) const override;
  Spectrum radiance(const Vec3&, const Vec3& way) const override { return sky_.seen(-way); }
  LargestFind largest_find(double) const override { return {pi * max(sky_.radiance, sky_.ground), Spectrum(infinite)}; }

 private:
  scene::Sky sky_;
  Frame up_;
  double cone_;  ///< of emission: 1 above alone, 2 all around
};

}  // namespace interflect::montecarlo

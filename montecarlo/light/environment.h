#pragma once

#include "montecarlo/light/afar.h"
#include "montecarlo/warp/table.h"
#include "scene/light.h"

namespace interflect::montecarlo {

/// Light from all around by a picture (scene::EnvironmentMap).  A texel is picked by its largest channel times its solid
/// angle, and a direction in it uniformly by solid angle (cosine and azimuth):
///
///   pdf_solid_angle = max_c L_c / sum over texels of max_c L_c Omega
class EnvironmentLight final : public LightFromAfar {
 public:
  /// @param map  must outlive it, and not be all dark
  EnvironmentLight(const scene::EnvironmentMap& map, const geometry::Box& box);

  Spectrum flux() const override { return disk_area() * integral_; }
  std::optional<Arriving> sample_arriving(const Place& at, double u, double v) const override;
  double pdf_arriving_solid_angle(const Place& at, const Vec3& way, const Vec3& position) const override;
  Emission sample_emission(const std::array<double, 4>& u) const override;
  EmissionPdfs pdfs_emission(const Vec3& position, const Vec3& way) const override;
  Spectrum radiance(const Vec3&, const Vec3& way) const override { return map_.seen(-way); }
  LargestFind largest_find(double) const override { return {pi * brightest_, Spectrum(table_.total())}; }

 private:
  struct Drawn {
    Vec3 way;
    Spectrum radiance;
    double pdf_solid_angle;
  };
  Drawn drawn(double u, double v) const;
  double pdf_of(int row, int column) const { return table_.probability(row, column) / map_.solid_angle(row); }

  const scene::EnvironmentMap& map_;
  CellTable table_;
  Spectrum integral_, brightest_;
};

}  // namespace interflect::montecarlo

#pragma once

#include <vector>

#include "core/random.h"
#include "geometry/box.h"
#include "measure/measurement.h"
#include "montecarlo/alias_table.h"
#include "montecarlo/receiver.h"

namespace interflect::montecarlo {

/// Where the light of a patch, a flux or a point is measured: places, uniform over all its patches together.
class ReceiverSampler {
 public:
  /// @pre  measure::PatchIrradiance, Flux or PointIrradiance, and require_measurable
  explicit ReceiverSampler(const measure::Measurement& asked);

  /// Dimensions: block 0, and 1 where there are several patches.
  Receiver draw(core::RandomNumbers& numbers) const;
  std::uint32_t blocks() const { return regions_.size() > 1 ? 2 : 1; }
  /// The place of (u, v) in the unit square: of several patches u says which, and where on it.
  Receiver at(double u, double v) const;
  /// Of that [1/m²]; 0 of a point.
  double pdf_area() const { return pdf_area_; }
  geometry::Box box() const;

 private:
  struct Region {
    scene::SurfacePatch patch;
    Vec3 normal;
    double first_share;  ///< first_triangle_share
  };
  void set_regions(std::span<const scene::SurfacePatch> patches);

  std::vector<Region> regions_;  ///< none of a point
  AliasTable pick_;              ///< among them, by area
  double pdf_area_ = 0;
  Receiver point_{};
};

}  // namespace interflect::montecarlo

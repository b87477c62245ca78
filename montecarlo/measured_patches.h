#pragma once

#include <span>
#include <vector>

#include "geometry/box_grid.h"
#include "measure/measurement.h"

namespace interflect::montecarlo {

/// Which of the measurements of patches (mean irradiance, flux) a point of a surface counts for.
class MeasuredPatches {
 public:
  explicit MeasuredPatches(std::span<const measure::Measurement> asked);

  /// What flux that arrives at a point of one of its patches adds to a measurement, per flux.
  struct Share {
    std::uint32_t measurement;
    double per_flux;  ///< 1 / area of a mean irradiance [1/m²]; 1 of a flux
  };
  /// @param found  overwritten
  void at(const scene::SurfacePoint& point, std::vector<Share>& found) const;

 private:
  struct Patch {
    scene::SurfacePatch patch;
    Vec3 normal;
    double thickness;  ///< how far off its plane a point may be found on it [m]
    Share share;
  };
  /// Those on a side of a surface.
  struct Part {
    std::vector<Patch> patches;
    geometry::BoxGrid grid;
  };
  void add(const scene::SurfacePatch& patch, const Share& share);

  std::vector<Part> parts_;  ///< [2 * surface + (side is back)]
};

}  // namespace interflect::montecarlo

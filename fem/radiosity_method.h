#pragma once

#include "fem/radiosity.h"
#include "measure/method.h"

namespace interflect::fem {

/// How a pixel is looked at.
struct PixelRays {
  int side = 4;         ///< side x side rays, one in each cell; of 1 the pixel's middle, and not its mean, is answered
  bool gather = false;  ///< where they hit, the iterated radiosity E + rho T B_h in place of B_h: shadows as they are
};

/// A radiosity solution as a method: answers measurements without solving again.
///
/// An element's or surface's irradiance is its Galerkin value; a point's is the iterated value (gather.h), never the
/// nearest element's; a pixel's is the mean of B / pi at the points that its rays see.
class RadiosityMethod final : public measure::Method {
 public:
  /// Both outlive the method.
  RadiosityMethod(const RadiositySolution& solution, const raycast::RayCaster& rays, PixelRays pixel = {})
      : solution_(solution), rays_(rays), pixel_(pixel) {}
  std::string name() const override { return "radiosity"; }
  measure::Capabilities capabilities() const override;
  std::vector<Estimate> answer(const scene::Scene& scene, std::span<const measure::Measurement> asked,
                               Run& run) const override;

 private:
  const RadiositySolution& solution_;
  const raycast::RayCaster& rays_;
  PixelRays pixel_;
};

}  // namespace interflect::fem

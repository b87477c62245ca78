#pragma once

#include "fem/radiosity.h"
#include "measure/method.h"

namespace interflect::fem {

/// A radiosity solution as a method: answers measurements without solving again.
///
/// An element's or surface's irradiance is its Galerkin value; a point's is the iterated value (gather.h), never the
/// nearest element's; a pixel's is the mean of B / pi at the points that its rays see.
class RadiosityMethod final : public measure::Method {
 public:
  /// Both outlive the method.
  RadiosityMethod(const RadiositySolution& solution, const raycast::RayCaster& rays)
      : solution_(solution), rays_(rays) {}
  std::string name() const override { return "radiosity"; }
  measure::Capabilities capabilities() const override { return {.unbiased = false, .consistent = true}; }
  std::vector<Estimate> answer(const scene::Scene& scene, std::span<const measure::Measurement> asked,
                               Run& run) const override;

 private:
  const RadiositySolution& solution_;
  const raycast::RayCaster& rays_;
};

}  // namespace interflect::fem

#pragma once

#include <string>
#include <utility>

#include "measure/method.h"
#include "measure/surface_solution.h"
#include "montecarlo/exposure.h"

namespace interflect::montecarlo {

struct SampleReport;

struct ControlledSettings {
  std::uint64_t samples = 0;  ///< per measurement; 0: as many as `target` asks for
  double target = 0.01;       ///< relative standard error
  std::string intersector = "embree";
  measure::PathClasses paths = measure::PathClasses::all();  ///< that count
  measure::SurfaceSolution solution;                         ///< however wrong
  SampleReport* report = nullptr;                            ///< of the samples, to be added to; null: none
  double target_floor = 0.1;  ///< ... or relative to this part of the scene's mean irradiance
  std::uint64_t max_samples = 1u << 26;
};

/// Path tracing with a radiosity solution as a control variate (controlled_paths.h).  Unbiased whatever the solution's
/// errors are: a wrong one makes noise, which the standard error tells.
///
/// A pilot of each measurement, 512 paths at most and thrown away, tells about what is expected of it and then its c.
/// Samples are independent, as a path tracer's, and planned as its are.  They have signs: of few, an estimate of what is
/// dark may be negative.
class Controlled final : public measure::Method {
 public:
  explicit Controlled(ControlledSettings settings) : settings_(std::move(settings)) {}
  std::string name() const override { return "controlled"; }
  measure::Capabilities capabilities() const override;
  /// @throws core::InputError  without a solution, with why there is none; and as PathTracer
  std::vector<Estimate> answer(const scene::Scene& scene, std::span<const measure::Measurement> asked,
                               Run& run) const override;

 private:
  ControlledSettings settings_;
};

/// @throws core::InputError  without one, with why there is none
void require_known(const measure::SurfaceSolution& solution);

/// Pictures: all pixels have one c, that of a pilot over them.
MakeExposure controlled_exposure;

}  // namespace interflect::montecarlo

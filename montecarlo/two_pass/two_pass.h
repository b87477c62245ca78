#pragma once

#include <string>
#include <utility>

#include "measure/method.h"
#include "measure/surface_solution.h"
#include "montecarlo/exposure.h"

namespace interflect::montecarlo {

struct SampleReport;

struct TwoPassSettings {
  std::uint64_t samples = 0;  ///< per measurement; 0: as many as `target` asks for
  double target = 0.01;       ///< relative standard error of what is sampled
  std::string intersector = "embree";
  measure::PathClasses paths = measure::PathClasses::all();  ///< all: the solution cannot leave any out
  measure::SurfaceSolution solution;                         ///< of A(D|S)*
  SampleReport* report = nullptr;                            ///< of the samples, to be added to; null: none
  double target_floor = 0.1;  ///< ... or relative to this part of the scene's mean irradiance
  std::uint64_t max_samples = 1u << 26;
};

/// Two passes [Sillion and Puech 1989]: radiosity for what is diffuse, by way of mirrors and smooth glass too, and paths
/// for what is seen in mirrors, through glass and by glossy surfaces (two_pass_estimator.h).  Patches and points gather
/// once by what they are; pixels do, so that no element shows.
///
/// Not unbiased, nor consistent, as the solution is given and its error stays, whatever the target: the error bound is
/// the mean of the solution's where walks end, and the standard error has the solution's noise beside that of
/// sampling.  Not of plastics and nets, whose diffuse part solutions do not know, nor of lights beside surfaces.
class TwoPass final : public measure::Method {
 public:
  explicit TwoPass(TwoPassSettings settings) : settings_(std::move(settings)) {}
  std::string name() const override { return "two-pass"; }
  measure::Capabilities capabilities() const override;
  /// @throws core::InputError  without a solution, with why there is none; in a scene that it does not know, or of some
  ///                           paths alone
  std::vector<Estimate> answer(const scene::Scene& scene, std::span<const measure::Measurement> asked,
                               Run& run) const override;

 private:
  TwoPassSettings settings_;
};

/// @throws core::InputError  as TwoPass::answer, whatever the solution
void require_known_to_two_passes(const scene::Scene& scene, const measure::PathClasses& paths);
/// The same, and without a solution why there is none.
void require_two_passes(const scene::Scene& scene, const measure::SurfaceSolution& solution,
                        const measure::PathClasses& paths);

/// Pictures by both passes; what the solution may err by, its noise and all, is a bound.
MakeExposure two_pass_exposure;

}  // namespace interflect::montecarlo

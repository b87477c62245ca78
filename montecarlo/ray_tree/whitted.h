#pragma once

#include <cstdint>
#include <string>

#include "measure/method.h"
#include "montecarlo/exposure.h"

namespace interflect::montecarlo {

struct SampleReport;

struct WhittedSettings {
  std::uint64_t samples = 0;  ///< points of the quadrature, a measurement; 0: until `target` seems met
  double target = 0.01;       ///< of that bound, relative to the weighted value
  double target_floor = 0.1;  ///< ... or relative to this part of the scene's mean irradiance
  std::uint64_t max_samples = 1u << 16;
  std::string intersector = "embree";
  measure::PathClasses paths = measure::PathClasses::all();  ///< that are asked for: it has no others than its own
  double least_weight = 1e-6;                                ///< a ray that counts less is not followed
  SampleReport* report = nullptr;  ///< of the samples behind the answers, to be added to; null: none
};

/// Whitted's ray tracing [1980]: from a pixel, rays go on at mirrors and smooth boundaries, both reflected and refracted,
/// each with its Fresnel weight, until they meet a surface that scatters; that is lit by all lights directly.  What is
/// measured elsewhere is lit directly.  It finds
///
///   L(D|G)?S*E  of pixels,   LE  of patches, fluxes and points.
///
/// Deterministic: points of the film, or of a patch, of the lights and of the lens are Sobol's in six dimensions, in
/// sixteen copies that are scrambled by fixed numbers of their own.  Standard errors are 0; the error bound, a claim that
/// is estimated, is how far the mean of any copy is from that of all, and
///
///   sum of the weights that were not followed  *  L_max
///
/// where L_max is the brightest of all lamps and of what was seen; the sun and the sky count where they were.  Were
/// copies normal, the mean would be off by more once in 400 000 times (of eight copies once in 390, which every picture
/// has).
class Whitted final : public measure::Method {
 public:
  explicit Whitted(WhittedSettings settings = {}) : settings_(std::move(settings)) {}
  std::string name() const override { return "whitted"; }
  measure::Capabilities capabilities() const override;

  /// @throws core::Interrupted  if it is stopped
  /// @throws core::InputError   for measurements that cannot be taken, paths that it misses, or settings out of range
  std::vector<Estimate> answer(const scene::Scene& scene, std::span<const measure::Measurement> asked,
                               Run& run) const override;

 private:
  WhittedSettings settings_;
};

/// The same trees, in sixteen copies of their points: whatever the seed, one picture.  Errors are those of the sixteen
/// means, 15 degrees of freedom, and bounds what was not followed, tree by tree.
MakeExposure whitted_exposure;

}  // namespace interflect::montecarlo

#pragma once

#include <cstdint>
#include <string>

#include "measure/method.h"
#include "montecarlo/exposure.h"

namespace interflect::montecarlo {

struct SampleReport;

struct DistributedSettings {
  std::uint64_t samples = 0;  ///< trees a measurement; 0: as many as `target` asks for
  double target = 0.01;       ///< relative standard error of every measurement's weighted value
  double target_floor = 0.1;  ///< ... or relative to this part of the scene's mean irradiance
  std::uint64_t max_samples = 1u << 26;
  std::string intersector = "embree";
  measure::PathClasses paths = measure::PathClasses::all();  ///< that are asked for: it has no others than its own
  SampleReport* report = nullptr;  ///< of the samples behind the answers, to be added to; null: none
};

/// Distributed ray tracing [Cook, Porter, Carpenter 1984]: Whitted's tree, with all that is not a point drawn at random:
/// the place on the pixel and on the lens, the light and the place on it, the direction that a glossy surface reflects
/// or refracts into.  Soft shadows, depth of field, blurred reflections.  It finds
///
///   L(D|G)?(S|G)*E  of pixels,   LE  of patches, fluxes and points.
///
/// Of its paths unbiased: a ray that counts w < 0.1 is followed with the probability w / 0.1 and counts 0.1 then, instead
/// of being cut.  Light that a glossy surface sends on is found by a pick of a light and by a ray that its Bsdf draws,
/// under the balance heuristic.  One whole tree is one sample.
/// Sample k of measurement m is keyed by (seed, m, k): same bits for any number of threads.
class Distributed final : public measure::Method {
 public:
  explicit Distributed(DistributedSettings settings = {}) : settings_(std::move(settings)) {}
  std::string name() const override { return "distributed"; }
  measure::Capabilities capabilities() const override;

  /// When the run is stopped, the estimates have fewer samples.
  /// @throws core::Interrupted  if some measurement has none yet
  /// @throws core::InputError   for measurements that cannot be taken, paths that it misses, or settings out of range
  std::vector<Estimate> answer(const scene::Scene& scene, std::span<const measure::Measurement> asked,
                               Run& run) const override;

 private:
  DistributedSettings settings_;
};

/// A whole tree is a sample of a pixel.
MakeExposure distributed_exposure;

}  // namespace interflect::montecarlo

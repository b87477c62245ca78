#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "measure/method.h"
#include "measure/path_classes.h"
#include "montecarlo/bidirectional/bidirectional_strategy.h"
#include "raycast/ray_caster.h"

namespace interflect::montecarlo {

struct SampleReport;

struct BidirectionalTracerSettings {
  std::uint64_t samples = 0;  ///< a measurement; 0: as many as `target` asks for
  double target = 0.01;       ///< relative standard error of every measurement's weighted value
  double target_floor = 0.1;  ///< ... or relative to this part of the scene's mean irradiance
  std::uint64_t max_samples = std::uint64_t{1} << 26;
  std::string intersector = "embree";
  measure::PathClasses paths = measure::PathClasses::all();  ///< that count
  std::optional<BidirectionalStrategy> only{};               ///< one strategy alone, unweighed
  SampleReport* report = nullptr;  ///< of the samples behind the answers, to be added to; null: none
};

/// Bidirectional path tracing (BidirectionalEstimator) of all that can be asked.
///
/// A sample of a patch, flux or point is a walk from there and one from a light, joined in all ways.  A sample of a
/// pixel is what it gets in a sweep (BidirectionalFilm), which all pixels of a camera share.  With a target, pilots that
/// are thrown away say how many samples are needed [Kirk, Arvo 1991].
/// Sample k of measurement m is keyed by (seed, m, k), of pixels by (seed, camera, pixel, k): same bits for any number
/// of threads.  Standard errors as of PathTracer.
class BidirectionalTracer final : public measure::Method {
 public:
  explicit BidirectionalTracer(BidirectionalTracerSettings settings = {}) : settings_(std::move(settings)) {}
  std::string name() const override { return "bidirectional"; }
  measure::Capabilities capabilities() const override;

  /// When the run is stopped, the estimates have fewer samples.
  /// @throws core::Interrupted  if some measurement has none yet
  /// @throws core::InputError   for measurements that cannot be taken, paths that it misses, or settings out of range
  std::vector<Estimate> answer(const scene::Scene& scene, std::span<const measure::Measurement> asked,
                               Run& run) const override;

 private:
  BidirectionalTracerSettings settings_;
};

}  // namespace interflect::montecarlo

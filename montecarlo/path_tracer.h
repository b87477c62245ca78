#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "measure/method.h"
#include "montecarlo/next_event.h"
#include "raycast/ray_caster.h"

namespace interflect::montecarlo {

struct SampleReport;

struct PathTracerSettings {
  std::uint64_t samples = 0;  ///< per measurement; 0: as many as `target` asks for
  double target = 0.01;       ///< relative standard error, per measurement, of its weighted value
  double target_floor = 0.1;  ///< ... or relative to this part of the scene's mean irradiance, so that dark places end
  std::uint64_t max_samples = 1u << 26;  ///< per measurement, by a target: those that it ends are warned of
  std::string intersector = "embree";
  measure::PathClasses paths = measure::PathClasses::all();  ///< that count
  SampleReport* report = nullptr;  ///< of the samples behind the answers, to be added to; null: none
  NextEvent next_event = NextEvent::yes;
};

/// Path tracing (Kajiya 1986): next-event estimation combined with direction sampling by multiple importance sampling
/// (balance heuristic, Veach and Guibas 1995), Russian roulette without a depth limit.  Unbiased.
///
/// With a target, a pilot of 1024 samples (and a second of n / 8 where it asks for n > 8192) says how many are needed,
/// at least 4096, and is thrown away (Kirk and Arvo 1991): the answer stays unbiased.  Nearly all measurements reach
/// the target.  Sample k of measurement m is keyed by (seed, m, k): same bits for any number of threads.
///
/// Light of points and spots is found where it is picked for the surface that it arrives on, and not by a mirror or
/// smooth glass: it refuses scenes that may have such light rather than leave it out.
///
/// Without next-event estimation, as Kajiya's first, light is found where a path happens to meet it: with far more noise
/// by small lights, and never that of points, spots and parallel light.
///
/// Standard errors are those of independent paths, of each channel and of the scene's weighted value.  A measurement
/// whose every sample scored zero while something emits has the standard error 3 w / n instead of 0 (rule of three; w:
/// PathEstimator::largest_score, in the measurement's unit), so that "nothing found" is never told as "nothing there".  A
/// scene without emitters is exactly dark: standard error 0, no samples.
class PathTracer final : public measure::Method {
 public:
  explicit PathTracer(PathTracerSettings settings = {}) : settings_(std::move(settings)) {}
  std::string name() const override { return settings_.next_event == NextEvent::yes ? "path" : "unidirectional"; }
  measure::Capabilities capabilities() const override;

  /// When the run is stopped, the estimates have fewer samples.
  /// @throws core::Interrupted  if some measurement has none yet
  /// @throws core::InputError   for a measurement that cannot be taken, paths that it misses, or settings out of range
  std::vector<Estimate> answer(const scene::Scene& scene, std::span<const measure::Measurement> asked,
                               Run& run) const override;
  /// The same with a ray caster of the scene that is there already.
  std::vector<Estimate> answer(const scene::Scene& scene, std::span<const measure::Measurement> asked, Run& run,
                               const raycast::RayCaster& caster) const;

  /// Samples behind all answers together, from a trial of 64 measurements at most, evenly spread over the list.
  double forecast_samples(const scene::Scene& scene, std::span<const measure::Measurement> asked, Run& run) const;
  /// Seconds that `answer` will take, pilots and all, at the speed of that trial; within a factor of two or so.
  double forecast(const scene::Scene& scene, std::span<const measure::Measurement> asked, Run& run) const;

 private:
  struct Trial {
    double samples = 0, pilots = 0;  ///< of all measurements
    double seconds_per_sample = 0;
  };
  Trial trial(const scene::Scene& scene, std::span<const measure::Measurement> asked, Run& run) const;

  PathTracerSettings settings_;
};

}  // namespace interflect::montecarlo

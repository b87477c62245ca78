#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "core/run.h"
#include "montecarlo/measurement_sampler.h"
#include "montecarlo/tally.h"

namespace interflect::montecarlo {

/// Samples 0 .. counts[m] - 1 of every measurement m, sample k being keyed by (seed, m, k).
///
/// Cut into blocks of samples, so that a single measurement keeps all threads busy; the blocks of a measurement are
/// merged in their order.  All measurements advance together: when the run is stopped, each has about the same part of
/// its samples.
/// @throws core::Interrupted  if it is stopped before every measurement has two samples
std::vector<Tally> sample_all(std::span<const MeasurementSampler> measurements, std::span<const std::uint64_t> counts,
                              const PathEstimator& paths, std::uint64_t seed, Run& run);

/// How exact the answers shall be.
struct SamplingTarget {
  double relative;             ///< standard error of the weighted value, relative to it
  double absolute;             ///< or absolute, for a measurement of scale 1 [lx | W/m²]
  std::uint64_t fewest, most;  ///< samples per measurement

  /// The standard error that will do for a measurement of this weighted mean and scale.
  double standard_error(double mean, double scale) const {
    return std::max(relative * std::abs(mean), absolute * scale);
  }
};

struct SamplingPlan {
  std::vector<std::uint64_t> counts;  ///< samples per measurement
  std::uint64_t spent = 0;            ///< samples of the pilots
};

/// How many samples each measurement needs, from pilots that are thrown away: so the answer stays unbiased [Kirk and
/// Arvo 1991].
///
///   n = 1.5 s² / target²,   s² of the pilot's weighted samples, target = SamplingTarget::standard_error;
///   3 w / n = target        where all of the pilot scored zero (rule of three, as in Tally::estimate).
///
/// The first pilot has 1024 samples.  Where it asks for more than eight times as many, a second one of n / 8 samples
/// (131 072 at most) decides: s² of few samples of a skewed distribution is too often far too small.  The factor 1.5
/// covers what noise is left, so that nearly all measurements reach their target.
SamplingPlan plan_samples(std::span<const MeasurementSampler> measurements, const PathEstimator& paths,
                          const SamplingTarget& target, Run& run);

/// Mean irradiance of all surfaces that can reflect if the scene were closed and well mixed: Phi / sum A (1 - rho), in
/// weighted channels [lx | W/m²].  A scale, not an answer.
/// @param flux  Phi of all lights, those from afar by what they send towards the scene
double mean_irradiance_scale(const scene::Scene& scene, const Spectrum& flux);

/// Enough to meet the rare bright path that makes most of the variance.
inline constexpr std::uint64_t pilot_samples = 1024;
/// Of a second pilot: more would cost time and interrupt late, and s² is known well.
inline constexpr std::uint64_t largest_pilot = 1u << 17;
/// Of a measurement with a target: its standard error is then worth something.
inline constexpr std::uint64_t fewest_samples = 4096;

}  // namespace interflect::montecarlo

#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "core/run.h"
#include "montecarlo/rare_light.h"
#include "montecarlo/sample_report.h"

namespace interflect::montecarlo {

/// Measurements that are sampled independently of each other, by whatever method: what is planned and added up here.
class SampledMeasurements {
 public:
  virtual ~SampledMeasurements() = default;
  virtual const scene::Scene& scene() const = 0;
  virtual std::string name() const = 0;   ///< "path tracer": of messages, and of the seeds
  virtual std::string doing() const = 0;  ///< "path tracing": of progress
  virtual std::size_t size() const = 0;
  /// What an irradiance of 1 everywhere would measure.
  virtual double scale(std::size_t measurement) const = 0;
  /// Of a measurement of scale 1, what a single sample finds at most, or nearly so.
  virtual Spectrum largest_score() const = 0;
  /// Light that samples find by chance alone.
  virtual const RareLights& rare_lights() const = 0;
  /// From where samples of a measurement look for it.
  virtual RareLights::From looks_from(std::size_t measurement) const = 0;
  /// The samples first, first + 1, .. of a measurement, sample k by the numbers of (seed, stream, k).
  /// @param samples  overwritten
  virtual void sample(std::size_t measurement, std::uint64_t seed, std::uint32_t stream, std::uint64_t first,
                      std::span<Spectrum> samples) const = 0;
  /// The same, with the light that each found, where samples are not that alone (Tally::add).
  virtual void sample_with_light(std::size_t measurement, std::uint64_t seed, std::uint32_t stream, std::uint64_t first,
                                 std::span<Spectrum> samples, std::span<Spectrum> light) const {
    sample(measurement, seed, stream, first, samples);
    std::copy(samples.begin(), samples.end(), light.begin());
  }
};

/// Samples 0 .. counts[m] - 1 of every measurement m, sample k being keyed by (seed, m, k).
///
/// Cut into blocks of samples, so that a single measurement keeps all threads busy; the blocks of a measurement are
/// merged in their order.  All measurements advance together: when the run is stopped, each has about the same part of
/// its samples.
/// @throws core::Interrupted  if it is stopped before every measurement has two samples
std::vector<Tally> sample_all(const SampledMeasurements& measurements, std::span<const std::uint64_t> counts,
                              std::uint64_t seed, Run& run);

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

struct SamplingSettings {
  std::uint64_t samples;  ///< of each measurement; 0: as many as `target` asks for
  double target;          ///< relative standard error of its weighted value
  double target_floor;    ///< ... or relative to this part of the scene's mean irradiance, so that dark places end
  std::uint64_t max_samples;
  SampleReport* report = nullptr;  ///< to be added to
};
/// Those of an integrator, whose own have the same names.
template <class Settings>
SamplingSettings sampling_of(const Settings& of) {
  return {of.samples, of.target, of.target_floor, of.max_samples, of.report};
}
/// @throws core::InputError  of `who`, for settings out of range
void require_valid(const SamplingSettings& settings, const std::string& who);
/// @param flux  of all lights [W | lm]
SamplingTarget target_of(const SamplingSettings& settings, const scene::Scene& scene, const Spectrum& flux,
                         std::uint64_t fewest);

/// Samples until a measurement is as well known as is asked for, from samples that are thrown away:
///
///   n = 1.5 s² / target²,   s² of their weighted values, target = SamplingTarget::standard_error;
///   3 w / n = target        where none found light (rule of three, as in Tally::estimate).
///
/// The factor 1.5 covers the noise of s², so that nearly all measurements reach their target.
/// @param largest_score  w, in the measurement's unit, weighed
std::uint64_t samples_needed(const core::ScalarMoments& pilot, double scale, double largest_score,
                             const SamplingTarget& target);

/// For which what they may lack is as little as the target, of a measurement of this weighted mean.
std::uint64_t samples_for(const RareLights& rare, double scale, double mean, const RareLights::From& from,
                          const SamplingTarget& target);

struct SamplingPlan {
  std::vector<std::uint64_t> counts;  ///< samples per measurement
  std::uint64_t spent = 0;            ///< samples of the pilots
};

/// How many samples each measurement needs, from pilots that are thrown away: so the answer stays unbiased [Kirk and
/// Arvo 1991].  The first pilot has 1024 samples.  Where it asks for more than eight times as many, a second one of n / 8
/// samples (131 072 at most) decides: s² of few samples of a skewed distribution is too often far too small.  As many are taken
/// as bring what they may lack (RareLights) below the target, too.
SamplingPlan plan_samples(const SampledMeasurements& measurements, const SamplingTarget& target, Run& run);

/// The answers, planned where there is a target; what is not finite, and measurements that a cap ended, are warned of.
/// @param flux  of all lights [W | lm]
/// @throws core::Interrupted  as sample_all
std::vector<Estimate> sampled_answers(const SampledMeasurements& measurements, const SamplingSettings& settings,
                                      const Spectrum& flux, Run& run);

/// Where nothing emits: exactly dark, without a sample.
inline std::vector<Estimate> dark_answers(std::size_t count) {
  return std::vector<Estimate>(count, unbiased_estimate(Spectrum::zero(), Spectrum::zero(), 0));
}

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

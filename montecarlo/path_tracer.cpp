#include "montecarlo/path_tracer.h"

#include <chrono>
#include <numeric>

#include "core/format.h"
#include "core/log.h"
#include "montecarlo/sampling.h"

namespace interflect::montecarlo {

namespace {

void require_valid(const PathTracerSettings& settings) {
  if (settings.samples == 0 && !(settings.target > 0))
    throw core::InputError("path tracer", "a target above 0 expected");
  if (!(settings.target_floor >= 0)) throw core::InputError("path tracer", "a target floor of at least 0 expected");
  if (settings.samples == 1 || settings.max_samples < 2)
    throw core::InputError("path tracer", "at least 2 samples expected: one has no standard error");
}

std::vector<MeasurementSampler> samplers_of(const scene::Scene& scene, std::span<const measure::Measurement> asked) {
  std::vector<MeasurementSampler> samplers;
  samplers.reserve(asked.size());
  for (const measure::Measurement& measurement : asked) samplers.emplace_back(scene, measurement);
  return samplers;
}

std::vector<std::uint64_t> sample_counts(const PathTracerSettings& settings, const scene::Scene& scene,
                                         std::span<const MeasurementSampler> measurements, const PathEstimator& paths,
                                         Run& run) {
  if (settings.samples > 0) return std::vector<std::uint64_t>(measurements.size(), settings.samples);
  const std::uint64_t fewest = std::min(fewest_samples, settings.max_samples);
  return plan_samples(scene, measurements, paths,
                      {settings.target, settings.target_floor, fewest, settings.max_samples}, run)
      .counts;
}

void warn_of_bugs(const Tally& tally, std::size_t measurement, std::uint64_t seed) {
  if (tally.not_finite > 0)
    core::log::warning(
        core::format("path tracer: %llu samples of measurement %zu are not finite and count as zero "
                     "(first: seed %llu, sample %llu)",
                     static_cast<unsigned long long>(tally.not_finite), measurement,
                     static_cast<unsigned long long>(seed), static_cast<unsigned long long>(tally.first_not_finite)));
}

}  // namespace

std::vector<Estimate> PathTracer::answer(const scene::Scene& scene, std::span<const measure::Measurement> asked,
                                         Run& run) const {
  require_valid(settings_);
  const std::vector<MeasurementSampler> measurements = samplers_of(scene, asked);
  const auto caster = raycast::make_ray_caster(settings_.intersector, scene);
  const PathEstimator paths(scene, *caster);
  if (paths.emitters().empty())
    return std::vector<Estimate>(asked.size(), unbiased_estimate(Spectrum::zero(), Spectrum::zero(), 0));

  const std::vector<std::uint64_t> counts = sample_counts(settings_, scene, measurements, paths, run);
  const std::uint64_t seed = core::derived_seed(run.seed, "path tracer");
  const std::vector<Tally> tallies = sample_all(measurements, counts, paths, seed, run);
  std::vector<Estimate> estimates;
  estimates.reserve(asked.size());
  for (std::size_t m = 0; m < tallies.size(); ++m) {
    warn_of_bugs(tallies[m], m, seed);
    estimates.push_back(tallies[m].estimate(measurements[m].scale() * paths.largest_score()));
  }
  return estimates;
}

double PathTracer::forecast(const scene::Scene& scene, std::span<const measure::Measurement> asked, Run& run) const {
  require_valid(settings_);
  if (asked.empty()) return 0;
  constexpr std::size_t trials = 64;
  std::vector<measure::Measurement> tried;  // evenly spread over the list
  for (std::size_t i = 0; i < std::min(trials, asked.size()); ++i)
    tried.push_back(asked[i * asked.size() / std::min(trials, asked.size())]);
  const std::vector<MeasurementSampler> measurements = samplers_of(scene, tried);
  const auto caster = raycast::make_ray_caster(settings_.intersector, scene);
  const PathEstimator paths(scene, *caster);
  if (paths.emitters().empty()) return 0;

  // With a number of samples given the trial is the pilot of a target that asks for no more than that.
  const double target = settings_.samples > 0 ? 1.0 : settings_.target;
  const auto start = std::chrono::steady_clock::now();
  const SamplingPlan plan = plan_samples(scene, measurements, paths,
                                         {target, settings_.target_floor, fewest_samples, settings_.max_samples}, run);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  const std::uint64_t samples = settings_.samples > 0
                                    ? settings_.samples * tried.size()
                                    : std::accumulate(plan.counts.begin(), plan.counts.end(), plan.spent);
  const double part = static_cast<double>(tried.size()) / static_cast<double>(asked.size());
  return elapsed.count() * static_cast<double>(samples) / static_cast<double>(plan.spent) / part;
}

}  // namespace interflect::montecarlo

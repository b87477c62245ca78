#include "montecarlo/path_tracer.h"

#include <chrono>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/error.h"
#include "core/format.h"
#include "core/log.h"
#include "montecarlo/sampling.h"
#include "montecarlo/scene_paths.h"

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

SamplingTarget target_of(const PathTracerSettings& settings, const PathEstimator& paths) {
  return {settings.target,
          settings.target * settings.target_floor * mean_irradiance_scale(paths.scene(), paths.lights().flux()),
          std::min(fewest_samples, settings.max_samples), settings.max_samples};
}

/// One line where measurements ended at the cap and not at their target.
void warn_of_cap(const scene::Scene& scene, const SamplingTarget& target,
                 std::span<const MeasurementSampler> measurements, std::span<const Estimate> found) {
  std::size_t stopped = 0;
  double worst = 1;  // standard error over that which was asked for
  for (std::size_t m = 0; m < found.size(); ++m) {
    const double wanted = target.standard_error(scene.weigh(found[m].value), measurements[m].scale());
    const double reached = weighed_standard_error(scene, found[m]);
    if (found[m].samples < target.most || reached <= wanted) continue;
    ++stopped;
    worst = std::max(worst, reached / wanted);
  }
  if (stopped > 0)
    core::log::warning(
        core::format("path tracer: %zu of %zu measurements stopped at %llu samples, the worst at %.2g %% where %.2g %% "
                     "was asked for",
                     stopped, found.size(), static_cast<unsigned long long>(target.most), 100 * worst * target.relative,
                     100 * target.relative));
}

}  // namespace

measure::Capabilities PathTracer::capabilities() const {
  const auto finds = measure::PathClasses::of("(A|F).*E|PE|P(D|G).*E");
  return {.unbiased = true, .consistent = true, .to_patches = finds, .to_points = finds, .to_pixels = finds};
}

std::vector<Estimate> PathTracer::answer(const scene::Scene& scene, std::span<const measure::Measurement> asked,
                                         Run& run) const {
  return answer(scene, asked, run, *raycast::make_ray_caster(settings_.intersector, scene));
}

std::vector<Estimate> PathTracer::answer(const scene::Scene& scene, std::span<const measure::Measurement> asked,
                                         Run& run, const raycast::RayCaster& caster) const {
  require_valid(settings_);
  require_found(*this, scene, asked, settings_.paths);
  const std::vector<MeasurementSampler> measurements = samplers_of(scene, asked);
  const PathEstimator paths(scene, caster, settings_.paths);
  if (paths.lights().empty())
    return std::vector<Estimate>(asked.size(), unbiased_estimate(Spectrum::zero(), Spectrum::zero(), 0));

  const SamplingTarget target = target_of(settings_, paths);
  const std::vector<std::uint64_t> counts = settings_.samples > 0
                                                ? std::vector<std::uint64_t>(asked.size(), settings_.samples)
                                                : plan_samples(measurements, paths, target, run).counts;
  const std::uint64_t seed = core::derived_seed(run.seed, "path tracer");
  const std::vector<Tally> tallies = sample_all(measurements, counts, paths, seed, run);
  std::vector<Estimate> estimates;
  estimates.reserve(asked.size());
  for (std::size_t m = 0; m < tallies.size(); ++m) {
    warn_of_bugs(tallies[m], "path tracer", m, seed);
    estimates.push_back(tallies[m].estimate(measurements[m].scale() * paths.largest_score()));
  }
  if (settings_.samples == 0) warn_of_cap(scene, target, measurements, estimates);
  return estimates;
}

PathTracer::Trial PathTracer::trial(const scene::Scene& scene, std::span<const measure::Measurement> asked,
                                    Run& run) const {
  require_valid(settings_);
  if (asked.empty()) return {};
  constexpr std::size_t trials = 64;
  std::vector<measure::Measurement> tried;  // evenly spread over the list
  for (std::size_t i = 0; i < std::min(trials, asked.size()); ++i)
    tried.push_back(asked[i * asked.size() / std::min(trials, asked.size())]);
  const std::vector<MeasurementSampler> measurements = samplers_of(scene, tried);
  const auto caster = raycast::make_ray_caster(settings_.intersector, scene);
  const PathEstimator paths(scene, *caster, settings_.paths);
  if (paths.lights().empty()) return {};

  SamplingTarget target = target_of(settings_, paths);
  if (settings_.samples > 0) target.absolute = std::numeric_limits<double>::infinity();  // first pilots, for the speed
  const auto start = std::chrono::steady_clock::now();
  const SamplingPlan plan = plan_samples(measurements, paths, target, run);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  const double planned = std::accumulate(plan.counts.begin(), plan.counts.end(), 0.0);
  const auto spent = static_cast<double>(plan.spent), all = static_cast<double>(asked.size());
  const double per_tried = all / static_cast<double>(tried.size()), speed = elapsed.count() / spent;
  if (settings_.samples > 0) return {static_cast<double>(settings_.samples) * all, 0, speed};
  return {planned * per_tried, spent * per_tried, speed};
}

double PathTracer::forecast_samples(const scene::Scene& scene, std::span<const measure::Measurement> asked,
                                    Run& run) const {
  return trial(scene, asked, run).samples;
}

double PathTracer::forecast(const scene::Scene& scene, std::span<const measure::Measurement> asked, Run& run) const {
  const Trial t = trial(scene, asked, run);
  return (t.samples + t.pilots) * t.seconds_per_sample;
}

}  // namespace interflect::montecarlo

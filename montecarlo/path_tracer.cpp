#include "montecarlo/path_tracer.h"

#include <chrono>
#include <limits>
#include <numeric>

#include "montecarlo/prepared_measurements.h"
#include "montecarlo/scene_paths.h"

namespace interflect::montecarlo {

namespace {

class PathTraced final : public PreparedMeasurements {
 public:
  PathTraced(const PathEstimator& paths, std::span<const measure::Measurement> asked, NextEvent next_event)
      : PreparedMeasurements(paths.scene(), asked, paths.rare_lights()), paths_(paths), next_event_(next_event) {}
  std::string name() const override { return path_tracer_name(next_event_); }
  std::string doing() const override { return "path tracing"; }
  Spectrum largest_score() const override { return paths_.largest_score(); }
  void sample(std::size_t m, std::uint64_t seed, std::uint32_t stream, std::uint64_t first,
              std::span<Spectrum> samples) const override {
    measured(m).sample(paths_, {seed, stream, first}, samples);
  }

 private:
  const PathEstimator& paths_;
  NextEvent next_event_;
};

}  // namespace

measure::Capabilities PathTracer::capabilities() const {
  const bool next_event = settings_.next_event == NextEvent::yes;
  const auto finds = measure::PathClasses::of(next_event ? "(A|F).*E|(P|B)((D|G).*)?E" : "(A|F).*E");
  return {.unbiased = true, .consistent = true, .to_patches = finds, .to_points = finds, .to_pixels = finds};
}

std::vector<Estimate> PathTracer::answer(const scene::Scene& scene, std::span<const measure::Measurement> asked,
                                         Run& run) const {
  return answer(scene, asked, run, *raycast::make_ray_caster(settings_.intersector, scene));
}

std::vector<Estimate> PathTracer::answer(const scene::Scene& scene, std::span<const measure::Measurement> asked,
                                         Run& run, const raycast::RayCaster& caster) const {
  require_valid(sampling_of(settings_), path_tracer_name(settings_.next_event));
  require_found(*this, scene, asked, settings_.paths);
  const PathEstimator paths(scene, caster, settings_.paths, settings_.next_event);
  const PathTraced measurements(paths, asked, settings_.next_event);
  if (paths.lights().empty()) return dark_answers(asked.size());
  return sampled_answers(measurements, sampling_of(settings_), paths.lights().flux(), run);
}

PathTracer::Trial PathTracer::trial(const scene::Scene& scene, std::span<const measure::Measurement> asked,
                                    Run& run) const {
  require_valid(sampling_of(settings_), path_tracer_name(settings_.next_event));
  if (asked.empty()) return {};
  constexpr std::size_t trials = 64;
  std::vector<measure::Measurement> tried;  // evenly spread over the list
  for (std::size_t i = 0; i < std::min(trials, asked.size()); ++i)
    tried.push_back(asked[i * asked.size() / std::min(trials, asked.size())]);
  const auto caster = raycast::make_ray_caster(settings_.intersector, scene);
  const PathEstimator paths(scene, *caster, settings_.paths, settings_.next_event);
  const PathTraced measurements(paths, tried, settings_.next_event);
  if (paths.lights().empty()) return {};

  SamplingTarget target = target_of(sampling_of(settings_), scene, paths.lights().flux(), fewest_samples);
  if (settings_.samples > 0) target.absolute = std::numeric_limits<double>::infinity();  // first pilots, for the speed
  const auto start = std::chrono::steady_clock::now();
  const SamplingPlan plan = plan_samples(measurements, target, run);
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

#include "montecarlo/controlled/controlled.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "core/control_variate.h"
#include "core/error.h"
#include "montecarlo/controlled/controlled_paths.h"
#include "montecarlo/path_tracer.h"
#include "montecarlo/prepared_measurements.h"
#include "montecarlo/scene_paths.h"

namespace interflect::montecarlo {
namespace {

constexpr std::uint32_t path_block = 2;  ///< after the place, or the film and the lens

/// What a pilot says of a measurement.
struct Expected {
  double irradiance = 0;  ///< about, of scale 1, weighed; 0: unknown
  double c = 1;
};

class ControlledMeasurements final : public PreparedMeasurements {
 public:
  ControlledMeasurements(const ControlledPaths& paths, std::span<const measure::Measurement> asked)
      : PreparedMeasurements(paths.paths().scene(), asked, paths.paths().rare_lights()),
        paths_(paths),
        expected_(asked.size()) {}
  std::string name() const override { return "controlled paths"; }
  std::string doing() const override { return "controlled path tracing"; }
  Spectrum largest_score() const override { return paths_.largest_score(); }
  void sample(std::size_t m, std::uint64_t seed, std::uint32_t stream, std::uint64_t first,
              std::span<Spectrum> samples) const override {
    std::vector<Spectrum> light(samples.size());
    sample_with_light(m, seed, stream, first, samples, light);
  }
  void sample_with_light(std::size_t m, std::uint64_t seed, std::uint32_t stream, std::uint64_t first,
                         std::span<Spectrum> samples, std::span<Spectrum> light) const override {
    std::vector<ControlledPaths::Found> found(samples.size());
    trace(m, {seed, stream, first}, found);
    for (std::size_t k = 0; k < samples.size(); ++k) {
      samples[k] = found[k].by(expected_[m].c);
      light[k] = found[k].path;
    }
  }

  /// Lets each be guided by paths of its own, which are not used again: one half tells F, and the other, that has this F
  /// and so the q of the samples, c.
  void learn(std::uint64_t paths, Run& run) {
    const std::uint64_t seed = core::derived_seed(run.seed, "controlled paths, what is expected");
    core::Progress::Stage stage(run.progress, doing() + " pilot", size());
    run.threads.for_blocks(static_cast<Index>(size()), 1, [&](Index begin, Index) {
      if (run.stop.stop_requested()) return;
      const auto m = static_cast<std::size_t>(begin);
      std::vector<ControlledPaths::Found> found(paths / 2);
      trace(m, {seed, static_cast<std::uint32_t>(m), 0}, found);
      expected_[m].irradiance = irradiance_by(found, scale(m));
      trace(m, {seed, static_cast<std::uint32_t>(m), found.size()}, found);
      expected_[m].c = factor_by(found);
      stage.advance();
    });
    run.throw_if_stopped(doing());
  }

 private:
  double irradiance_by(std::span<const ControlledPaths::Found> found, double scale) const {
    core::ScalarMoments sum;
    for (const ControlledPaths::Found& each : found) sum.add(scene().weigh(each.by(1)));
    return std::max(0.0, sum.mean() / scale);
  }
  double factor_by(std::span<const ControlledPaths::Found> found) const {
    core::ControlVariate pilot(0, 3);
    for (const ControlledPaths::Found& each : found) pilot.add(scene().weigh(each.path), scene().weigh(each.control));
    return control_factor(pilot);
  }

  void trace(std::size_t m, const PathEstimator::Keys& keys, std::span<ControlledPaths::Found> found) const {
    const MeasurementSampler& of = measured(m);
    const auto starts = [&](auto start_of) {
      std::vector<decltype(start_of(std::declval<core::RandomNumbers&>()))> all;
      all.reserve(found.size());
      for (std::size_t k = 0; k < found.size(); ++k) {
        core::RandomNumbers numbers = keys.numbers(k);
        all.push_back(start_of(numbers));
      }
      return all;
    };
    if (of.is_pixel()) {
      const auto rays = starts([&](core::RandomNumbers& numbers) { return of.ray(numbers); });
      paths_.radiance(rays, keys, path_block, found);
      return;
    }
    const auto places = starts([&](core::RandomNumbers& numbers) { return of.receiver(numbers); });
    paths_.irradiance(places, keys, path_block, expected_[m].irradiance, found);
    for (ControlledPaths::Found& each : found) each.path *= of.scale(), each.control *= of.scale();
  }

  const ControlledPaths& paths_;
  std::vector<Expected> expected_;
};

/// Of a measurement: few beside those that count.
std::uint64_t paths_of_pilot(std::uint64_t samples) {
  constexpr std::uint64_t most = 512;
  return samples == 0 ? most : std::clamp<std::uint64_t>(samples / 8, 64, most);
}

}  // namespace

void require_known(const measure::SurfaceSolution& solution) {
  if (!solution.known())
    throw core::InputError(solution.why_none.empty() ? "controlled: it needs a radiosity solution" : solution.why_none);
}

measure::Capabilities Controlled::capabilities() const { return PathTracer().capabilities(); }

std::vector<Estimate> Controlled::answer(const scene::Scene& scene, std::span<const measure::Measurement> asked,
                                         Run& run) const {
  require_valid(sampling_of(settings_), "controlled");
  require_known(settings_.solution);
  require_found(*this, scene, asked, settings_.paths);
  const auto caster = raycast::make_ray_caster(settings_.intersector, scene);
  const ControlledPaths paths(scene, *caster, settings_.solution, settings_.paths);
  if (paths.paths().lights().empty()) return dark_answers(asked.size());
  ControlledMeasurements measurements(paths, asked);
  measurements.learn(paths_of_pilot(settings_.samples), run);
  return sampled_answers(measurements, sampling_of(settings_), paths.paths().lights().flux(), run);
}

}  // namespace interflect::montecarlo

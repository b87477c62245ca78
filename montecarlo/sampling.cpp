#include "montecarlo/sampling.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "montecarlo/waves.h"

namespace interflect::montecarlo {

namespace {

constexpr double pilot_margin = 1.5;  ///< for the noise of a pilot's own s²

Tally sample_block(const MeasurementSampler& measurement, const SampleBlock& block, const PathEstimator& paths,
                   std::uint64_t seed) {
  Tally tally;
  for (std::uint64_t k = block.first; k < block.end; ++k) {
    core::RandomNumbers numbers(seed, block.measurement, k);
    const Spectrum sample = measurement.sample(paths, numbers);
    tally.add(sample, paths.scene().weigh(sample), k);
  }
  return tally;
}

/// Samples that are only counted with.
struct Pilot {
  const PathEstimator& paths;
  const SamplingTarget& target;
  std::uint64_t seed;

  std::uint64_t needed(const MeasurementSampler& measurement, std::uint32_t stream, std::uint64_t samples) const {
    core::ScalarMoments weighed;
    for (std::uint64_t k = 0; k < samples; ++k) {
      core::RandomNumbers numbers(seed, stream, k);
      weighed.add(paths.scene().weigh(measurement.sample(paths, numbers)));
    }
    const double variance = weighed.variance(), scale = measurement.scale();
    const double wanted = target.standard_error(weighed.mean(), scale);
    const double rule_of_three = 3 * scale * paths.scene().weigh(paths.largest_score()) / wanted;
    const double n = variance > 0          ? pilot_margin * variance / (wanted * wanted)
                     : weighed.mean() != 0 ? 0
                                           : rule_of_three;
    // Not a number (0 / 0, or the pilot met a sample that is not finite): the fewest will do.
    if (!(n > static_cast<double>(target.fewest))) return target.fewest;
    return static_cast<std::uint64_t>(std::ceil(std::min(n, static_cast<double>(target.most))));
  }
};

}  // namespace

std::vector<Tally> sample_all(std::span<const MeasurementSampler> measurements, std::span<const std::uint64_t> counts,
                              const PathEstimator& paths, std::uint64_t seed, Run& run) {
  std::uint64_t total = 0;
  for (const std::uint64_t count : counts) total += count;
  core::Progress::Stage stage(run.progress, "path tracing", total);
  std::vector<Tally> tallies(measurements.size());
  Waves waves(counts);
  for (std::vector<SampleBlock> wave = waves.next(); !wave.empty() && !run.stop.stop_requested(); wave = waves.next()) {
    std::vector<Tally> found(wave.size());
    run.threads.for_blocks(static_cast<Index>(wave.size()), 1, [&](Index begin, Index) {
      if (run.stop.stop_requested()) return;
      const auto b = static_cast<std::size_t>(begin);
      found[b] = sample_block(measurements[wave[b].measurement], wave[b], paths, seed);
      stage.advance(wave[b].end - wave[b].first);
    });
    for (std::size_t b = 0; b < wave.size(); ++b) tallies[wave[b].measurement].merge(found[b]);
  }
  for (const Tally& tally : tallies)
    if (tally.moments.count() < 2) run.throw_if_stopped("path tracing");
  return tallies;
}

double mean_irradiance_scale(const scene::Scene& scene, const Spectrum& flux) {
  const double white = scene.weigh(Spectrum(1));
  double absorbing = 0;
  for (const scene::SurfaceId id : scene.surface_ids())
    for (const scene::Side side : {scene::Side::front, scene::Side::back})
      if (scene.material(id).active(side))
        absorbing += scene.area(id) * (1 - scene.weigh(scene.material(id).reflectance_of(side)) / white);
  return absorbing > 0 ? scene.weigh(flux) / absorbing : 0;
}

SamplingPlan plan_samples(std::span<const MeasurementSampler> measurements, const PathEstimator& paths,
                          const SamplingTarget& target, Run& run) {
  const Pilot first{paths, target, core::derived_seed(run.seed, "path tracer pilot")};
  const Pilot second{paths, target, core::derived_seed(run.seed, "path tracer second pilot")};
  core::Progress::Stage stage(run.progress, "path tracing pilot", measurements.size());
  SamplingPlan plan{std::vector<std::uint64_t>(measurements.size(), target.fewest)};
  std::vector<std::uint64_t> spent(measurements.size(), pilot_samples);
  run.threads.for_blocks(static_cast<Index>(measurements.size()), 1, [&](Index begin, Index) {
    if (run.stop.stop_requested()) return;
    const auto m = static_cast<std::size_t>(begin);
    std::uint64_t n = first.needed(measurements[m], static_cast<std::uint32_t>(m), pilot_samples);
    if (const std::uint64_t more = std::min(n / 8, largest_pilot); more > pilot_samples) {
      spent[m] += more;
      n = second.needed(measurements[m], static_cast<std::uint32_t>(m), more);
    }
    plan.counts[m] = n;
    stage.advance();
  });
  run.throw_if_stopped("path tracing");
  plan.spent = std::accumulate(spent.begin(), spent.end(), std::uint64_t{0});
  return plan;
}

}  // namespace interflect::montecarlo

#include "montecarlo/sampling.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace interflect::montecarlo {

namespace {

constexpr std::uint64_t samples_per_block = 256;
constexpr std::size_t blocks_per_wave = 8192;  ///< results kept at once: about 1 MB
constexpr double pilot_margin = 1.5;           ///< for the noise of a pilot's own s²

struct Block {
  std::uint32_t measurement;
  std::uint64_t first, end;
};

/// Blocks round by round: the first of every measurement, the second of every measurement that has one, ...
class Waves {
 public:
  explicit Waves(std::span<const std::uint64_t> counts) : counts_(counts) {}

  std::vector<Block> next() {
    std::vector<Block> wave;
    while (wave.size() < blocks_per_wave && add_round(wave)) ++round_;
    return wave;
  }

 private:
  bool add_round(std::vector<Block>& wave) const {
    const std::size_t before = wave.size();
    const std::uint64_t first = round_ * samples_per_block;
    for (std::uint32_t m = 0; m < counts_.size(); ++m)
      if (first < counts_[m]) wave.push_back({m, first, std::min(first + samples_per_block, counts_[m])});
    return wave.size() > before;
  }

  std::span<const std::uint64_t> counts_;
  std::uint64_t round_ = 0;
};

Tally sample_block(const MeasurementSampler& measurement, const Block& block, const PathEstimator& paths,
                   std::uint64_t seed) {
  Tally tally;
  for (std::uint64_t k = block.first; k < block.end; ++k) {
    core::RandomNumbers numbers(seed, block.measurement, k);
    tally.add(measurement.sample(paths, numbers), k);
  }
  return tally;
}

/// Samples that are only counted with.
struct Pilot {
  const scene::Scene& scene;
  const PathEstimator& paths;
  const SamplingTarget& target;
  double floor;  ///< absolute, for a measurement of scale 1
  std::uint64_t seed;

  std::uint64_t needed(const MeasurementSampler& measurement, std::uint32_t stream, std::uint64_t samples) const {
    core::Moments weighted;
    for (std::uint64_t k = 0; k < samples; ++k) {
      core::RandomNumbers numbers(seed, stream, k);
      weighted.add(Spectrum(scene.weigh(measurement.sample(paths, numbers))));
    }
    const double mean = std::abs(weighted.mean()[0]), variance = weighted.variance()[0], scale = measurement.scale();
    const double wanted = std::max(target.relative * mean, floor * scale);
    const double rule_of_three = 3 * scale * scene.weigh(paths.largest_score()) / wanted;
    const double n = variance > 0 ? pilot_margin * variance / (wanted * wanted) : mean > 0 ? 0 : rule_of_three;
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
  for (std::vector<Block> wave = waves.next(); !wave.empty() && !run.stop.stop_requested(); wave = waves.next()) {
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

double mean_irradiance_scale(const scene::Scene& scene) {
  const double white = scene.weigh(Spectrum(1));
  double absorbing = 0;
  for (const scene::SurfaceId id : scene.surface_ids())
    for (const scene::Side side : {scene::Side::front, scene::Side::back})
      if (scene.material(id).active(side))
        absorbing += scene.area(id) * (1 - scene.weigh(scene.material(id).reflectance_of(side)) / white);
  return absorbing > 0 ? scene.weigh(scene.emitted_flux()) / absorbing : 0;
}

SamplingPlan plan_samples(const scene::Scene& scene, std::span<const MeasurementSampler> measurements,
                          const PathEstimator& paths, const SamplingTarget& target, Run& run) {
  const double floor = target.floor * mean_irradiance_scale(scene);
  const Pilot first{scene, paths, target, floor, core::derived_seed(run.seed, "path tracer pilot")};
  const Pilot second{scene, paths, target, floor, core::derived_seed(run.seed, "path tracer second pilot")};
  core::Progress::Stage stage(run.progress, "path tracing pilot", measurements.size());
  SamplingPlan plan{std::vector<std::uint64_t>(measurements.size(), target.fewest)};
  std::vector<std::uint64_t> spent(measurements.size(), pilot_samples);
  run.threads.for_blocks(static_cast<Index>(measurements.size()), 1, [&](Index begin, Index) {
    if (run.stop.stop_requested()) return;
    const auto m = static_cast<std::size_t>(begin);
    std::uint64_t n = first.needed(measurements[m], static_cast<std::uint32_t>(m), pilot_samples);
    if (const std::uint64_t more = n / 8; more > pilot_samples) {
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

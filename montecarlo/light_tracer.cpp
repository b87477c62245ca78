#include "montecarlo/light_tracer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.h"
#include "core/format.h"
#include "core/log.h"
#include "montecarlo/light_paths.h"
#include "montecarlo/measurable.h"
#include "montecarlo/sampling.h"
#include "montecarlo/scene_paths.h"
#include "montecarlo/tally.h"

namespace interflect::montecarlo {
namespace {

constexpr std::uint64_t paths_per_block = 256, blocks_per_wave = 1024;
constexpr std::uint64_t first_pilot = 1u << 14, largest_light_pilot = 1u << 20;
constexpr std::uint64_t fewest_scores = 25;  ///< below which an interval is too short by far

/// What paths add to measurements.
struct Scores {
  struct Score {
    std::uint32_t measurement;
    Tally tally;  ///< of the paths that added something
  };
  std::vector<Score> of;
};

Scores scores_of_block(const LightPaths& paths, const scene::Scene& scene, std::uint64_t seed, std::uint64_t first,
                       std::uint64_t end) {
  struct Entry {
    std::uint32_t measurement;
    std::uint64_t path;
    Spectrum value;
  };
  std::vector<Entry> entries;
  Deposits deposits;
  for (std::uint64_t k = first; k < end; ++k) {
    core::RandomNumbers numbers(seed, 0, k);
    deposits.clear();
    paths.trace(numbers, deposits);
    for (const auto& [measurement, value] : deposits.of()) entries.push_back({measurement, k, value});
  }
  std::stable_sort(entries.begin(), entries.end(),
                   [](const Entry& a, const Entry& b) { return a.measurement < b.measurement; });
  Scores scores;
  for (const Entry& each : entries) {
    if (scores.of.empty() || scores.of.back().measurement != each.measurement)
      scores.of.push_back({each.measurement, {}});
    scores.of.back().tally.add(each.value, scene.weigh(each.value), each.path);
  }
  return scores;
}

/// Paths that added nothing.
Tally of_none(std::uint64_t count) {
  Tally tally;
  tally.moments = core::Moments(count, Spectrum::zero(), Spectrum::zero());
  tally.weighed = core::ScalarMoments(count, 0, 0);
  return tally;
}

/// The same paths for all measurements, from the first on.
class Tracing {
 public:
  Tracing(const LightPaths& paths, const scene::Scene& scene, std::span<const measure::Measurement> asked,
          std::uint64_t seed)
      : paths_(paths), scene_(scene), asked_(asked), seed_(seed), scored_(asked.size()) {}

  std::uint64_t paths() const { return done_; }
  std::uint64_t scores(std::size_t measurement) const { return scored_[measurement].moments.count(); }
  Tally tally(std::size_t measurement) const {
    Tally all = scored_[measurement];
    all.merge(of_none(done_ - scores(measurement)));
    return all;
  }

  /// So many more, or fewer where the run is stopped.
  void trace(std::uint64_t count, const char* stage_name, Run& run) {
    const std::uint64_t until = done_ + count;
    core::Progress::Stage stage(run.progress, stage_name, count);
    while (done_ < until && !run.stop.stop_requested()) {
      const std::uint64_t some = std::min(until - done_, paths_per_block * blocks_per_wave);
      const auto blocks = static_cast<Index>((some + paths_per_block - 1) / paths_per_block);
      std::vector<Scores> of(static_cast<std::size_t>(blocks));
      run.threads.for_blocks(blocks, 1, [&](Index b, Index) {
        const std::uint64_t first = done_ + static_cast<std::uint64_t>(b) * paths_per_block,
                            end = std::min(first + paths_per_block, done_ + some);
        of[static_cast<std::size_t>(b)] = scores_of_block(paths_, scene_, seed_, first, end);
        stage.advance(end - first);
      });
      for (const Scores& block : of)
        for (const auto& [measurement, tally] : block.of) scored_[measurement].merge(tally);
      done_ += some;
    }
  }

  /// What a path adds at most; of points and pixels, which have no such bound, what light adds at once.
  Spectrum largest_score(std::size_t measurement) const {
    const measure::Measurement& asked = asked_[measurement];
    if (const auto* patch = std::get_if<measure::PatchIrradiance>(&asked))
      return paths_.lights().flux() / patch->patch.area;
    if (std::holds_alternative<measure::Flux>(asked)) return paths_.lights().flux();
    return paths_.lights().largest_find() * scale_of(asked);
  }
  /// What few paths score, or none, may be more by three of the largest scores (the rule of three).
  Spectrum standard_error(std::size_t measurement, const Tally& tally) const {
    const Spectrum known = tally.moments.standard_error();
    if (scores(measurement) >= fewest_scores) return known;
    return max(known, largest_score(measurement) * (3 / static_cast<double>(done_)));
  }

  /// Paths until it is as well known as is asked for, and half as many more for the noise of that.
  double needed(std::size_t measurement, const SamplingTarget& target) const {
    const Tally of = tally(measurement);
    const double wanted = target.standard_error(of.weighed.mean(), scale_of(asked_[measurement]));
    if (scores(measurement) < fewest_scores) return 3 * scene_.weigh(largest_score(measurement)) / wanted;
    return 1.5 * of.weighed.variance() / (wanted * wanted);
  }

 private:
  const LightPaths& paths_;
  const scene::Scene& scene_;
  std::span<const measure::Measurement> asked_;
  std::uint64_t seed_;
  std::vector<Tally> scored_;  ///< by measurement
  std::uint64_t done_ = 0;
};

/// Which measurements are answered, and not one of them again.
std::vector<std::size_t> answered(std::size_t asked, const SplatTargets& targets) {
  std::vector<bool> is_again(asked, false);
  for (const auto& [again, as] : targets.again()) is_again[again] = true;
  std::vector<std::size_t> answered;
  for (std::size_t m = 0; m < asked; ++m)
    if (!is_again[m]) answered.push_back(m);
  return answered;
}

/// How many paths all of them need, by pilots that are thrown away: so the answer stays unbiased [Kirk, Arvo 1991].
std::uint64_t planned(const LightPaths& paths, const scene::Scene& scene, std::span<const measure::Measurement> asked,
                      std::span<const std::size_t> of, const SamplingTarget& target, Run& run) {
  const auto by_pilot = [&](std::uint64_t size, const char* purpose) {
    Tracing pilot(paths, scene, asked, core::derived_seed(run.seed, purpose));
    pilot.trace(size, "light tracing pilot", run);
    run.throw_if_stopped("light tracing");
    double most = static_cast<double>(target.fewest);
    for (const std::size_t m : of) most = std::max(most, pilot.needed(m, target));  // not if it is no number
    return std::min(most, static_cast<double>(target.most));
  };
  double n = by_pilot(first_pilot, "light tracer pilot");
  if (const auto more = static_cast<std::uint64_t>(std::min(n / 8, static_cast<double>(largest_light_pilot)));
      more > first_pilot)
    n = by_pilot(more, "light tracer second pilot");
  return static_cast<std::uint64_t>(std::ceil(n));
}

/// One line where paths ended before all measurements were as well known as was asked for.
void warn_of_cap(const Tracing& tracing, const scene::Scene& scene, std::span<const measure::Measurement> asked,
                 std::span<const std::size_t> of, const SamplingTarget& target) {
  const auto falls_short = [&](std::size_t m) {
    const Tally tally = tracing.tally(m);
    return scene.weigh(tracing.standard_error(m, tally)) >
           target.standard_error(tally.weighed.mean(), scale_of(asked[m]));
  };
  if (const auto count = std::ranges::count_if(of, falls_short); count > 0)
    core::log::warning(core::format("light tracing: %td of %zu measurements stopped short of %.2g %% at %llu paths",
                                    count, asked.size(), 100 * target.relative,
                                    static_cast<unsigned long long>(tracing.paths())));
}

}  // namespace

/// What leaves a surface that is no mirror last can be joined with points and pixels; light at once is drawn from points,
/// and pixels see lights that a path starts on.
measure::Capabilities LightTracer::capabilities() const {
  return {.unbiased = true,
          .consistent = true,
          .to_points = measure::PathClasses::of("L(.*(D|G))?E"),
          .to_pixels = measure::PathClasses::of("AE|L.*(D|G)E")};
}

std::vector<Estimate> LightTracer::answer(const scene::Scene& scene, std::span<const measure::Measurement> asked,
                                          Run& run) const {
  require_valid(sampling_of(settings_), "light tracing");
  for (const measure::Measurement& each : asked) require_measurable(scene, each);
  require_found(*this, scene, asked, settings_.paths);
  const auto caster = raycast::make_ray_caster(settings_.intersector, scene);
  const LightPaths paths(scene, asked, *caster, settings_.paths);
  std::vector<Estimate> estimates(asked.size(), unbiased_estimate(Spectrum::zero(), Spectrum::zero(), 0));
  if (paths.dark()) return estimates;
  const std::vector<std::size_t> of = answered(asked.size(), paths.targets());
  const SamplingTarget target = target_of(sampling_of(settings_), scene, paths.lights().flux(), first_pilot);
  const std::uint64_t count = settings_.samples > 0 ? settings_.samples : planned(paths, scene, asked, of, target, run);
  const std::uint64_t seed = core::derived_seed(run.seed, "light tracer");
  Tracing tracing(paths, scene, asked, seed);
  tracing.trace(count, "light tracing", run);
  if (tracing.paths() < 2) run.throw_if_stopped("light tracing");
  for (const std::size_t m : of) {
    const Tally tally = tracing.tally(m);
    warn_of_bugs(tally, "light tracing", m, seed);
    if (settings_.report != nullptr) settings_.report->add(m, tally);
    estimates[m] = tally.estimate(tracing.largest_score(m));
    estimates[m].standard_error = tracing.standard_error(m, tally);
    if (tracing.scores(m) < fewest_scores)
      estimates[m].weighed_standard_error = scene.weigh(estimates[m].standard_error);
  }
  for (const auto& [again, as] : paths.targets().again()) estimates[again] = estimates[as];
  if (settings_.samples == 0 && count == target.most && !run.stop.stop_requested())
    warn_of_cap(tracing, scene, asked, of, target);
  return estimates;
}

}  // namespace interflect::montecarlo

#include "montecarlo/sampling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "core/error.h"
#include "core/format.h"
#include "core/log.h"
#include "core/random.h"
#include "montecarlo/waves.h"

namespace interflect::montecarlo {

namespace {

constexpr double pilot_margin = 1.5;  ///< for the noise of a pilot's own s²

Tally sample_block(const SampledMeasurements& measurements, std::size_t m, std::uint64_t seed, std::uint64_t first,
                   std::uint64_t end) {
  std::array<Spectrum, Waves::samples_per_block> samples, light;
  Tally tally;
  for (; first < end; first += samples.size()) {
    const std::span<Spectrum> some = std::span(samples).first(std::min<std::uint64_t>(samples.size(), end - first));
    measurements.sample_with_light(m, seed, static_cast<std::uint32_t>(m), first, some,
                                   std::span(light).first(some.size()));
    for (std::size_t k = 0; k < some.size(); ++k)
      tally.add(some[k], measurements.scene().weigh(some[k]), first + k, light[k]);
  }
  return tally;
}

/// Weighed, of the light: what is a control variate's alone tells nothing of how rare that is.
core::ScalarMoments known_of(const Tally& pilot) {
  return pilot.found_none() ? core::ScalarMoments(pilot.moments.count(), 0, 0) : pilot.weighed;
}

/// One line where measurements ended at the cap and not at their target.
void warn_of_cap(const SampledMeasurements& measurements, const SamplingTarget& target,
                 std::span<const Estimate> found) {
  const scene::Scene& scene = measurements.scene();
  std::size_t stopped = 0;
  double worst = 1;  // standard error over that which was asked for
  for (std::size_t m = 0; m < found.size(); ++m) {
    const double wanted = target.standard_error(scene.weigh(found[m].value), measurements.scale(m));
    const double reached = weighed_standard_error(scene, found[m]);
    if (found[m].samples < target.most || reached <= wanted) continue;
    ++stopped;
    worst = std::max(worst, reached / wanted);
  }
  if (stopped > 0)
    core::log::warning(core::format(
        "%s: %zu of %zu measurements stopped at %llu samples, the worst at %.2g %% where %.2g %% was asked for",
        measurements.name().c_str(), stopped, found.size(), static_cast<unsigned long long>(target.most),
        100 * worst * target.relative, 100 * target.relative));
}

}  // namespace

std::vector<Tally> sample_all(const SampledMeasurements& measurements, std::span<const std::uint64_t> counts,
                              std::uint64_t seed, Run& run) {
  std::uint64_t total = 0;
  for (const std::uint64_t count : counts) total += count;
  core::Progress::Stage stage(run.progress, measurements.doing(), total);
  std::vector<Tally> tallies(measurements.size());
  Waves waves(counts);
  for (std::vector<SampleBlock> wave = waves.next(); !wave.empty() && !run.stop.stop_requested(); wave = waves.next()) {
    std::vector<Tally> found(wave.size());
    run.threads.for_blocks(static_cast<Index>(wave.size()), 1, [&](Index begin, Index) {
      if (run.stop.stop_requested()) return;
      const auto b = static_cast<std::size_t>(begin);
      found[b] = sample_block(measurements, wave[b].measurement, seed, wave[b].first, wave[b].end);
      stage.advance(wave[b].end - wave[b].first);
    });
    for (std::size_t b = 0; b < wave.size(); ++b) tallies[wave[b].measurement].merge(found[b]);
  }
  for (const Tally& tally : tallies)
    if (tally.moments.count() < 2) run.throw_if_stopped(measurements.doing());
  return tallies;
}

void require_valid(const SamplingSettings& settings, const std::string& who) {
  if (settings.samples == 0 && !(settings.target > 0)) throw core::InputError(who, "a target above 0 expected");
  if (!(settings.target_floor >= 0)) throw core::InputError(who, "a target floor of at least 0 expected");
  if (settings.samples == 1 || settings.max_samples < 2)
    throw core::InputError(who, "at least 2 samples expected: one has no standard error");
}

SamplingTarget target_of(const SamplingSettings& settings, const scene::Scene& scene, const Spectrum& flux,
                         std::uint64_t fewest) {
  return {settings.target, settings.target * settings.target_floor * mean_irradiance_scale(scene, flux),
          std::min(fewest, settings.max_samples), settings.max_samples};
}

std::uint64_t samples_needed(const core::ScalarMoments& pilot, double scale, double largest_score,
                             const SamplingTarget& target) {
  const double variance = pilot.variance(), wanted = target.standard_error(pilot.mean(), scale);
  const double n = variance > 0        ? pilot_margin * variance / (wanted * wanted)
                   : pilot.mean() != 0 ? 0
                                       : 3 * largest_score / wanted;
  // Not a number (0 / 0, or the pilot met a sample that is not finite): the fewest will do.
  if (!(n > static_cast<double>(target.fewest))) return target.fewest;
  return static_cast<std::uint64_t>(std::ceil(std::min(n, static_cast<double>(target.most))));
}

std::uint64_t samples_for(const RareLights& rare, double scale, double mean, const RareLights::From& from,
                          const SamplingTarget& target) {
  const double wanted = target.standard_error(mean, scale) / scale;
  if (!(wanted > 0)) return 0;
  return static_cast<std::uint64_t>(
      std::ceil(std::min(rare.samples_for(wanted, from), static_cast<double>(target.most))));
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

SamplingPlan plan_samples(const SampledMeasurements& measurements, const SamplingTarget& target, Run& run) {
  const std::uint64_t first = core::derived_seed(run.seed, measurements.name() + " pilot"),
                      second = core::derived_seed(run.seed, measurements.name() + " second pilot");
  core::Progress::Stage stage(run.progress, measurements.doing() + " pilot", measurements.size());
  SamplingPlan plan{std::vector<std::uint64_t>(measurements.size(), target.fewest)};
  std::vector<std::uint64_t> spent(measurements.size(), pilot_samples);
  const RareLights& rare = measurements.rare_lights();
  run.threads.for_blocks(static_cast<Index>(measurements.size()), 1, [&](Index begin, Index) {
    if (run.stop.stop_requested()) return;
    const auto m = static_cast<std::size_t>(begin);
    const double scale = measurements.scale(m),
                 largest = scale * measurements.scene().weigh(measurements.largest_score());
    const auto count = [&](std::uint64_t seed, std::uint64_t samples) {
      const core::ScalarMoments known = known_of(sample_block(measurements, m, seed, 0, samples));
      const std::uint64_t needed = samples_needed(known, scale, largest, target);
      if (rare.empty()) return needed;
      return std::max(needed, samples_for(rare, scale, known.mean(), measurements.looks_from(m), target));
    };
    std::uint64_t n = count(first, pilot_samples);
    if (const std::uint64_t more = std::min(n / 8, largest_pilot); more > pilot_samples) {
      spent[m] += more;
      n = count(second, more);
    }
    plan.counts[m] = n;
    stage.advance();
  });
  run.throw_if_stopped(measurements.doing());
  plan.spent = std::accumulate(spent.begin(), spent.end(), std::uint64_t{0});
  return plan;
}

std::vector<Estimate> sampled_answers(const SampledMeasurements& measurements, const SamplingSettings& settings,
                                      const Spectrum& flux, Run& run) {
  const SamplingTarget target = target_of(settings, measurements.scene(), flux, fewest_samples);
  const std::vector<std::uint64_t> counts = settings.samples > 0
                                                ? std::vector<std::uint64_t>(measurements.size(), settings.samples)
                                                : plan_samples(measurements, target, run).counts;
  const std::uint64_t seed = core::derived_seed(run.seed, measurements.name());
  const std::vector<Tally> tallies = sample_all(measurements, counts, seed, run);
  std::vector<Estimate> estimates;
  estimates.reserve(tallies.size());
  const RareLights& rare = measurements.rare_lights();
  SampleReport ignored;
  SampleReport& report = settings.report != nullptr ? *settings.report : ignored;
  for (std::size_t m = 0; m < tallies.size(); ++m) {
    warn_of_bugs(tallies[m], measurements.name().c_str(), m, seed);
    report.add(m, tallies[m]);
    estimates.push_back(tallies[m].estimate(measurements.scale(m) * measurements.largest_score()));
    if (!rare.empty()) rare.add_to(estimates.back(), measurements.scale(m), measurements.looks_from(m), m, report);
  }
  if (settings.samples == 0) warn_of_cap(measurements, target, estimates);
  return estimates;
}

}  // namespace interflect::montecarlo

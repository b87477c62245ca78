#include "montecarlo/bidirectional/bidirectional_tracer.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "core/error.h"
#include "core/format.h"
#include "core/log.h"
#include "montecarlo/bidirectional/bidirectional_film.h"
#include "montecarlo/measurable.h"
#include "montecarlo/measured_patches.h"
#include "montecarlo/receiver_sampler.h"
#include "montecarlo/sampling.h"
#include "montecarlo/scene_paths.h"
#include "montecarlo/waves.h"

namespace interflect::montecarlo {
namespace {

constexpr std::uint32_t walk_block = 2;  ///< of the eye's walk, after its place

/// A patch, a flux or a point, ready to be sampled.
class Surfaced {
 public:
  explicit Surfaced(const measure::Measurement& asked)
      : place_(asked), scale_(scale_of(asked)), patches_({&asked, 1}) {}

  double scale() const { return scale_; }
  Spectrum sample(const BidirectionalEstimator& walks, core::RandomNumbers& numbers) const {
    LightWalk light;
    walks.walk_from_light(numbers, light);
    const Receiver at = place_.draw(numbers);
    Spectrum found = scale_ * walks.irradiance(at, place_.pdf_area(), light, numbers, walk_block);
    if (place_.pdf_area() == 0) return found;
    std::vector<MeasuredPatches::Share> shares;
    for (std::size_t x = 0; x < light.vertices.size(); ++x) {
      patches_.at(light.vertices[x].hit, shares);
      for (const auto& [measurement, per_flux] : shares) found += per_flux * walks.arrival(light, x, place_.pdf_area());
    }
    return found;
  }

 private:
  ReceiverSampler place_;
  double scale_;  ///< what an irradiance of 1 measures
  MeasuredPatches patches_;
};

/// The pixels of one camera that are asked for, and which measurements they are.
struct Pixels {
  std::vector<std::uint32_t> pixels;
  std::vector<std::vector<std::size_t>> measurements;  ///< by pixel: it may be asked for again
};

std::map<std::uint32_t, Pixels> pixels_of(const scene::Scene& scene, std::span<const measure::Measurement> asked) {
  std::map<std::uint32_t, std::map<std::uint32_t, std::vector<std::size_t>>> found;
  for (std::size_t m = 0; m < asked.size(); ++m)
    if (const auto* pixel = std::get_if<measure::PixelRadiance>(&asked[m]))
      found[pixel->camera.value][static_cast<std::uint32_t>(pixel->y * scene.camera(pixel->camera).width + pixel->x)]
          .push_back(m);
  std::map<std::uint32_t, Pixels> by_camera;
  for (const auto& [camera, of] : found)
    for (const auto& [pixel, measurements] : of) {
      by_camera[camera].pixels.push_back(pixel);
      by_camera[camera].measurements.push_back(measurements);
    }
  return by_camera;
}

/// All samples 0 .. count - 1 of every pixel.
std::vector<Tally> tallies_of(const BidirectionalFilm& film, std::uint64_t count, const scene::Scene& scene,
                              const char* stage_name, Run& run) {
  core::Progress::Stage stage(run.progress, stage_name, count);
  std::vector<Tally> tallies(film.pixels());
  for (std::uint64_t k = 0; k < count && !run.stop.stop_requested();) {
    const std::uint64_t end = std::min(count, k + film.sweeps_at_once());
    const std::vector<Spectrum> samples = film.samples(k, end, run);
    for (std::size_t s = 0; s < samples.size(); ++s)
      tallies[s % film.pixels()].add(samples[s], scene.weigh(samples[s]), k + s / film.pixels());
    stage.advance(end - k);
    k = end;
  }
  return tallies;
}

class Answers {
 public:
  Answers(const BidirectionalTracerSettings& settings, const scene::Scene& scene,
          std::span<const measure::Measurement> asked, const BidirectionalEstimator& walks, Run& run)
      : settings_(settings),
        scene_(scene),
        asked_(asked),
        walks_(walks),
        run_(run),
        target_{settings.target,
                settings.target * settings.target_floor * mean_irradiance_scale(scene, walks.lights().flux()),
                std::min(fewest_samples, settings.max_samples), settings.max_samples},
        estimates_(asked.size()) {}

  std::vector<Estimate> all() {
    surfaced();
    for (const auto& [camera, pixels] : pixels_of(scene_, asked_)) of_film(scene::CameraId{camera}, pixels);
    return std::move(estimates_);
  }

 private:
  std::uint64_t needed(const Tally& pilot, double scale) const {
    const double variance = pilot.weighed.variance(), mean = pilot.weighed.mean(),
                 wanted = target_.standard_error(mean, scale);
    const double n = variance > 0 ? 1.5 * variance / (wanted * wanted)
                     : mean != 0  ? 0
                                  : 3 * scale * scene_.weigh(largest_score()) / wanted;
    if (!(n > static_cast<double>(target_.fewest))) return target_.fewest;
    return static_cast<std::uint64_t>(std::ceil(std::min(n, static_cast<double>(target_.most))));
  }
  Spectrum largest_score() const { return 2 * walks_.lights().largest_find(); }

  void surfaced() {
    std::vector<Surfaced> measured;
    std::vector<std::size_t> of;
    for (std::size_t m = 0; m < asked_.size(); ++m)
      if (!std::holds_alternative<measure::PixelRadiance>(asked_[m])) measured.emplace_back(asked_[m]), of.push_back(m);
    if (of.empty()) return;
    std::vector<std::uint64_t> counts(of.size(), settings_.samples);
    if (settings_.samples == 0) {
      const auto by_pilot = [&](const std::vector<std::uint64_t>& sizes, const char* purpose) {
        const auto pilots = sample(measured, of, sizes, core::derived_seed(run_.seed, purpose), "bidirectional pilot");
        run_.throw_if_stopped("bidirectional path tracing");
        for (std::size_t i = 0; i < of.size(); ++i)
          if (pilots[i].moments.count() > 0) counts[i] = needed(pilots[i], measured[i].scale());
      };
      by_pilot(std::vector<std::uint64_t>(of.size(), pilot_samples), "bidirectional pilot");
      std::vector<std::uint64_t> more;
      for (const std::uint64_t n : counts) {
        const std::uint64_t second = std::min(n / 8, largest_pilot);
        more.push_back(second > pilot_samples ? second : 0);
      }
      by_pilot(more, "bidirectional second pilot");
    }
    const std::uint64_t seed = core::derived_seed(run_.seed, "bidirectional");
    const std::vector<Tally> tallies = sample(measured, of, counts, seed, "bidirectional path tracing");
    for (std::size_t i = 0; i < of.size(); ++i) {
      if (tallies[i].moments.count() < 2) run_.throw_if_stopped("bidirectional path tracing");
      warn_of_bugs(tallies[i], "bidirectional path tracing", of[i], seed);
      estimates_[of[i]] = tallies[i].estimate(measured[i].scale() * largest_score());
    }
  }

  std::vector<Tally> sample(const std::vector<Surfaced>& measured, const std::vector<std::size_t>& of,
                            const std::vector<std::uint64_t>& counts, std::uint64_t seed, const char* stage_name) {
    std::uint64_t total = 0;
    for (const std::uint64_t count : counts) total += count;
    core::Progress::Stage stage(run_.progress, stage_name, total);
    std::vector<Tally> tallies(measured.size());
    Waves waves(counts);
    for (auto wave = waves.next(); !wave.empty() && !run_.stop.stop_requested(); wave = waves.next()) {
      std::vector<Tally> found(wave.size());
      run_.threads.for_blocks(static_cast<Index>(wave.size()), 1, [&](Index begin, Index) {
        if (run_.stop.stop_requested()) return;
        const SampleBlock& block = wave[static_cast<std::size_t>(begin)];
        for (std::uint64_t k = block.first; k < block.end; ++k) {
          core::RandomNumbers numbers(seed, static_cast<std::uint32_t>(of[block.measurement]), k);
          const Spectrum found_one = measured[block.measurement].sample(walks_, numbers);
          found[static_cast<std::size_t>(begin)].add(found_one, scene_.weigh(found_one), k);
        }
        stage.advance(block.end - block.first);
      });
      for (std::size_t b = 0; b < wave.size(); ++b) tallies[wave[b].measurement].merge(found[b]);
    }
    return tallies;
  }

  void of_film(scene::CameraId camera, const Pixels& asked) {
    const auto filter = make_filter("box");
    const std::string name = core::format("bidirectional film %u", camera.value);
    const auto film = [&](const std::string& purpose) {
      return BidirectionalFilm(walks_, scene_.camera(camera), asked.pixels, *filter,
                               core::derived_seed(run_.seed, purpose));
    };
    std::uint64_t count = settings_.samples;
    if (count == 0) {
      const auto by_pilot = [&](std::uint64_t size, const std::string& purpose) {
        const auto pilots = tallies_of(film(purpose), size, scene_, "bidirectional pilot", run_);
        run_.throw_if_stopped("bidirectional path tracing");
        count = 0;
        for (const Tally& pilot : pilots) count = std::max(count, needed(pilot, inv_pi));
      };
      by_pilot(pilot_samples, name + " pilot");
      if (const std::uint64_t more = std::min(count / 8, largest_pilot); more > pilot_samples)
        by_pilot(more, name + " second pilot");
    }
    const auto tallies = tallies_of(film(name), count, scene_, "bidirectional path tracing", run_);
    for (std::size_t p = 0; p < tallies.size(); ++p) {
      if (tallies[p].moments.count() < 2) run_.throw_if_stopped("bidirectional path tracing");
      for (const std::size_t m : asked.measurements[p]) {
        warn_of_bugs(tallies[p], "bidirectional path tracing", m, core::derived_seed(run_.seed, name));
        estimates_[m] = tallies[p].estimate(inv_pi * largest_score());
      }
    }
  }

  const BidirectionalTracerSettings& settings_;
  const scene::Scene& scene_;
  std::span<const measure::Measurement> asked_;
  const BidirectionalEstimator& walks_;
  Run& run_;
  SamplingTarget target_;
  std::vector<Estimate> estimates_;
};

void require_valid(const BidirectionalTracerSettings& settings) {
  if (settings.samples == 0 && !(settings.target > 0))
    throw core::InputError("bidirectional path tracing", "a target above 0 expected");
  if (!(settings.target_floor >= 0))
    throw core::InputError("bidirectional path tracing", "a target floor of at least 0 expected");
  if (settings.samples == 1 || settings.max_samples < 2)
    throw core::InputError("bidirectional path tracing", "at least 2 samples expected: one has no standard error");
}

}  // namespace

/// Light of points needs two places in a row that walks can be joined at, or one before a point or pixel, or the first;
/// patches are met by the light's walk itself.
measure::Capabilities BidirectionalTracer::capabilities() const {
  const auto finds = measure::PathClasses::of("(A|F).*E|PE|P(D|G).*E|P.*(D|G)(D|G).*E|P.*(D|G)E");
  return {.unbiased = true, .consistent = true, .to_points = finds, .to_pixels = finds};
}

std::vector<Estimate> BidirectionalTracer::answer(const scene::Scene& scene,
                                                  std::span<const measure::Measurement> asked, Run& run) const {
  require_valid(settings_);
  for (const measure::Measurement& each : asked) require_measurable(scene, each);
  require_found(*this, scene, asked, settings_.paths);
  const auto caster = raycast::make_ray_caster(settings_.intersector, scene);
  const BidirectionalEstimator walks(scene, *caster, settings_.paths, settings_.only);
  if (walks.dark())
    return std::vector<Estimate>(asked.size(), unbiased_estimate(Spectrum::zero(), Spectrum::zero(), 0));
  return Answers(settings_, scene, asked, walks, run).all();
}

}  // namespace interflect::montecarlo

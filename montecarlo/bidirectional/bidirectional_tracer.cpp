#include "montecarlo/bidirectional/bidirectional_tracer.h"

#include <algorithm>
#include <map>

#include "core/format.h"
#include "montecarlo/bidirectional/bidirectional_film.h"
#include "montecarlo/measurable.h"
#include "montecarlo/measured_patches.h"
#include "montecarlo/prepared_measurements.h"
#include "montecarlo/scene_paths.h"

namespace interflect::montecarlo {
namespace {

constexpr std::uint32_t walk_block = 2;  ///< of the eye's walk, after its place

constexpr const char* who = "bidirectional path tracer";
constexpr const char* what = "bidirectional path tracing";

/// Patches, fluxes and points.
class Joined final : public PreparedMeasurements {
 public:
  Joined(const BidirectionalEstimator& walks, std::span<const measure::Measurement> asked,
         const measure::PathClasses& paths)
      : PreparedMeasurements(walks.scene(), asked, {walks.scene(), walks.lights(), paths}), walks_(walks) {
    patches_.reserve(asked.size());
    for (const measure::Measurement& each : asked) patches_.emplace_back(std::span(&each, 1));
  }
  std::string name() const override { return who; }
  std::string doing() const override { return what; }
  Spectrum largest_score() const override { return walks_.largest_score(); }
  /// Patches are met by the light's walk too: by their share of what walks from afar cover.
  RareLights::From looks_from(std::size_t m) const override {
    RareLights::From from = PreparedMeasurements::looks_from(m);
    if (const double pdf_area = measured(m).pdf_area(); pdf_area > 0 && !walks_.is_one_alone())
      from.walked_to = std::min(1.0, 1 / (pdf_area * walks_.lights().section()));
    return from;
  }
  void sample(std::size_t m, std::uint64_t seed, std::uint32_t stream, std::uint64_t first,
              std::span<Spectrum> samples) const override {
    LightWalk light;
    std::vector<MeasuredPatches::Share> shares;
    for (std::size_t k = 0; k < samples.size(); ++k) {
      core::RandomNumbers numbers(seed, stream, first + k);
      walks_.walk_from_light(numbers, light);
      samples[k] = of_walks(m, light, numbers, shares);
    }
  }

 private:
  Spectrum of_walks(std::size_t m, const LightWalk& light, core::RandomNumbers& numbers,
                    std::vector<MeasuredPatches::Share>& shares) const {
    const double pdf_area = measured(m).pdf_area();
    const Receiver at = measured(m).receiver(numbers);
    Spectrum found = scale(m) * walks_.irradiance(at, pdf_area, light, numbers, walk_block);
    if (pdf_area == 0) return found;
    for (std::size_t x = 0; x < light.vertices.size(); ++x) {
      patches_[m].at(light.vertices[x].hit, shares);
      for (const auto& [measurement, per_flux] : shares) found += per_flux * walks_.arrival(light, x, pdf_area);
    }
    return found;
  }

  const BidirectionalEstimator& walks_;
  std::vector<MeasuredPatches> patches_;  ///< of each alone
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
    const std::uint64_t end = std::min(count, k + film.at_once());
    const std::vector<Spectrum> samples = film.samples(k, end, run);
    for (std::size_t s = 0; s < samples.size(); ++s)
      tallies[s % film.pixels()].add(samples[s], scene.weigh(samples[s]), k + s / film.pixels());
    stage.advance(end - k);
    k = end;
  }
  return tallies;
}

/// Whether a pixel shows what mirrors, or nearly, by as many rays as tell.
bool shows_what_is_smooth(const scene::Scene& scene, const raycast::RayCaster& caster, const scene::FilmMap& film,
                          const Vec2& corner) {
  constexpr int each_way = 8;
  for (int k = 0; k < each_way * each_way; ++k) {
    const Vec2 at = corner + Vec2(k % each_way + .5, k / each_way + .5) / each_way;
    const auto ray = film.ray(at);
    const auto hit = ray ? caster.closest({ray->origin, ray->direction}) : std::nullopt;
    if (hit && RareLights::throws_narrowly(scene.material(hit->surface))) return true;
  }
  return false;
}

/// Light that pixels may lack.  Walks from lights are seen by one as often as by another, but where it shows what is
/// smooth: what that throws into a pinhole they cannot bring.
struct RareInPixels {
  RareLights light;
  std::vector<RareLights::From> from;  ///< by pixel

  RareInPixels(const BidirectionalEstimator& walks, const raycast::RayCaster& caster, const measure::PathClasses& paths,
               const scene::Camera& camera, const Pixels& asked)
      : light(walks.scene(), walks.lights(), paths), from(asked.pixels.size()) {
    if (light.empty()) return;
    const scene::FilmMap film(camera);
    const geometry::Box box = walks.scene().box();
    const double by_one = 1 / (static_cast<double>(camera.width) * camera.height);
    for (std::size_t p = 0; p < from.size(); ++p) {
      const auto [row, column] = std::div(static_cast<int>(asked.pixels[p]), camera.width);
      const bool found = !walks.is_one_alone() && !shows_what_is_smooth(walks.scene(), caster, film, Vec2(column, row));
      from[p] = {box, true, found ? by_one : 0};
    }
  }
};

/// How many sweeps all pixels need, by pilots that are thrown away, as plan_samples does it.
std::uint64_t sweeps_needed(const BidirectionalEstimator& walks, const RareInPixels& rare, const scene::Camera& camera,
                            const Pixels& asked, const ReconstructionFilter& filter, const std::string& purpose,
                            const SamplingTarget& target, Run& run) {
  const double largest = inv_pi * walks.scene().weigh(walks.largest_score());
  const auto by_pilot = [&](std::uint64_t size, const char* which) {
    const BidirectionalFilm film(walks, camera, asked.pixels, filter, core::derived_seed(run.seed, purpose + which));
    std::uint64_t most = 0;
    const auto pilots = tallies_of(film, size, walks.scene(), "bidirectional pilot", run);
    for (std::size_t p = 0; p < pilots.size(); ++p)
      most = std::max({most, samples_needed(pilots[p].weighed, inv_pi, largest, target),
                       samples_for(rare.light, inv_pi, pilots[p].weighed.mean(), rare.from[p], target)});
    run.throw_if_stopped(what);
    return most;
  };
  const std::uint64_t count = by_pilot(pilot_samples, " pilot"), more = std::min(count / 8, largest_pilot);
  return more > pilot_samples ? by_pilot(more, " second pilot") : count;
}

/// The pixels of one camera, into `estimates`.
void answer_film(const BidirectionalEstimator& walks, const RareInPixels& rare, scene::CameraId camera,
                 const Pixels& asked, const SamplingSettings& settings, Run& run, std::vector<Estimate>& estimates) {
  const scene::Scene& scene = walks.scene();
  const auto filter = make_filter("box");
  const std::string purpose = core::format("%s film %u", who, camera.value);
  const SamplingTarget target = target_of(settings, scene, walks.lights().flux(), fewest_samples);
  const std::uint64_t count = settings.samples > 0 ? settings.samples
                                                   : sweeps_needed(walks, rare, scene.camera(camera), asked, *filter,
                                                                   purpose, target, run),
                      seed = core::derived_seed(run.seed, purpose);
  const BidirectionalFilm film(walks, scene.camera(camera), asked.pixels, *filter, seed);
  const auto tallies = tallies_of(film, count, scene, what, run);
  SampleReport ignored;
  SampleReport& report = settings.report != nullptr ? *settings.report : ignored;
  for (std::size_t p = 0; p < tallies.size(); ++p) {
    if (tallies[p].moments.count() < 2) run.throw_if_stopped(what);
    for (const std::size_t m : asked.measurements[p]) {
      warn_of_bugs(tallies[p], what, m, seed);
      report.add(m, tallies[p]);
      estimates[m] = tallies[p].estimate(inv_pi * walks.largest_score());
      rare.light.add_to(estimates[m], inv_pi, rare.from[p], m, report);
    }
  }
}

/// All that are no pixels, into `estimates`.
void answer_places(const BidirectionalEstimator& walks, std::span<const measure::Measurement> asked,
                   const BidirectionalTracerSettings& settings, Run& run, std::vector<Estimate>& estimates) {
  std::vector<measure::Measurement> places;
  std::vector<std::size_t> of;
  for (std::size_t m = 0; m < asked.size(); ++m)
    if (!std::holds_alternative<measure::PixelRadiance>(asked[m])) places.push_back(asked[m]), of.push_back(m);
  if (places.empty()) return;
  SamplingSettings sampling = sampling_of(settings);
  SampleReport report;
  sampling.report = &report;
  const Joined joined(walks, places, settings.paths);
  const auto found = sampled_answers(joined, sampling, walks.lights().flux(), run);
  if (settings.report != nullptr) settings.report->add(report, of);
  for (std::size_t k = 0; k < of.size(); ++k) estimates[of[k]] = found[k];
}

}  // namespace

/// Light of points needs two places in a row that walks can be joined at, or one before a point or pixel, or the first;
/// patches are met by the light's walk itself.
measure::Capabilities BidirectionalTracer::capabilities() const {
  const auto finds = measure::PathClasses::of("(A|F).*E|(P|B)(.*(D|G)(D|G).*|.*(D|G)|(D|G).*)?E");
  return {.unbiased = true, .consistent = true, .to_points = finds, .to_pixels = finds};
}

std::vector<Estimate> BidirectionalTracer::answer(const scene::Scene& scene,
                                                  std::span<const measure::Measurement> asked, Run& run) const {
  require_valid(sampling_of(settings_), who);
  for (const measure::Measurement& each : asked) require_measurable(scene, each);
  require_found(*this, scene, asked, settings_.paths);
  const auto caster = raycast::make_ray_caster(settings_.intersector, scene);
  const BidirectionalEstimator walks(scene, *caster, settings_.paths, settings_.only);
  std::vector<Estimate> estimates = dark_answers(asked.size());
  if (walks.dark()) return estimates;
  answer_places(walks, asked, settings_, run, estimates);
  for (const auto& [camera, pixels] : pixels_of(scene, asked))
    answer_film(walks, {walks, *caster, settings_.paths, scene.camera({camera}), pixels}, {camera}, pixels,
                sampling_of(settings_), run, estimates);
  return estimates;
}

}  // namespace interflect::montecarlo

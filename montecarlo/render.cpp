#include "montecarlo/render.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>

#include "core/error.h"
#include "core/format.h"
#include "core/log.h"
#include "core/seconds_since.h"
#include "montecarlo/film/film.h"
#include "montecarlo/film/reconstruction_filter.h"
#include "montecarlo/integrators.h"
#include "montecarlo/scene_paths.h"
#include "montecarlo/tally.h"
#include "scene/film_map.h"

namespace interflect::montecarlo {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::uint64_t first_look = 64;

int batches_of(const RenderSettings& settings) {
  return settings.independent() && !integrator_entry(settings.integrator).by_quadrature ? 0 : sequence_batches;
}

void require_valid(const scene::Scene& scene, scene::CameraId id, const RenderSettings& settings) {
  if (id.value >= scene.cameras.size()) throw core::InputError("render", "a camera of the scene expected");
  scene::require_valid(scene.camera(id));
  const measure::Measurement pixel = measure::PixelRadiance{id, 0, 0};
  const IntegratorEntry& integrator = integrator_entry(settings.integrator);
  if (integrator.expose == nullptr)
    throw core::InputError("integrator '" + settings.integrator + "'", "one whose pictures grow expected");
  require_found(*integrator.make({}), scene, {&pixel, 1}, settings.paths);
  if (!(settings.target >= 0)) throw core::InputError("render", "a target of at least 0 expected");
  if (settings.integrator != "path" && !settings.independent())
    throw core::InputError("render", "numbers of a sequence are for path tracing alone");
  if (settings.samples == 0) throw core::InputError("render", "at least one sample a pixel expected");
  if (batches_of(settings) > 0 && settings.samples % sequence_batches != 0)
    throw core::InputError(
        "render", core::format("samples of %s come in %d randomisations, which say how large errors are: a multiple of "
                               "%d a pixel expected, not %llu",
                               settings.independent() ? settings.integrator.c_str()
                                                      : ("the sequence '" + settings.sequence + "'").c_str(),
                               sequence_batches, sequence_batches, static_cast<unsigned long long>(settings.samples)));
}

std::size_t pixels_of(const scene::Camera& camera) {
  return static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height);
}

Film empty_film(const scene::Scene& scene, std::size_t pixels, const RenderSettings& settings) {
  const IntegratorEntry& integrator = integrator_entry(settings.integrator);
  return {pixels, scene.channel_count(), batches_of(settings), integrator.by_quadrature || integrator.inherits_error};
}

/// Nothing was found that weighs.
bool is_dark(const scene::Scene& scene, const Estimate& pixel) {
  return scene.weigh(pixel.value) == 0 && pixel.claim != Claim::none;
}

/// Noise, and as much more as makes of 95 % of it what covers a bound too.
template <class T>
T error_of(const T& standard_error, const T& bound) {
  return standard_error + bound * (1 / normal_95);
}

class Painter {
 public:
  Painter(const scene::Scene& scene, scene::CameraId id, const RenderSettings& settings, Run& run,
          const raycast::RayCaster& caster, const RenderCheckpoints& checkpoints)
      : scene_(scene),
        settings_(settings),
        camera_(scene.camera(id)),
        map_(camera_),
        filter_(make_filter(settings.filter)),
        exposure_(integrator_entry(settings.integrator).expose(scene, camera_, settings, *filter_, caster, run)),
        run_(run),
        checkpoints_(checkpoints),
        film_(empty_film(scene, pixels_of(camera_), settings)) {
    if (checkpoints.from != nullptr) film_.restore(*checkpoints.from);
    for (std::size_t p = 0; p < film_.pixels(); ++p)
      if (film_.samples(p) > settings.samples)
        throw core::InputError("render", core::format("there are %llu samples a pixel already, more than %llu",
                                                      static_cast<unsigned long long>(film_.samples(p)),
                                                      static_cast<unsigned long long>(settings.samples)));
  }

  Rendering paint() {
    std::uint64_t before = 0;
    for (std::size_t p = 0; p < film_.pixels(); ++p) before += film_.samples(p);
    core::Progress::Stage stage(run_.progress, "rendering " + camera_.name, settings_.samples * film_.pixels());
    stage.advance(before);
    const auto after_some = [&] {
      if (checkpoints_.keep && core::seconds_since(saved_) >= checkpoints_.seconds_between) keep();
    };
    bool good_enough = false;
    for (std::uint64_t done = film_.fewest_samples(); done < settings_.samples && !good_enough && !stopped();) {
      const std::uint64_t look = next_look(done);
      done = exposure_->pass(film_, done, look, stage, after_some);
      good_enough = done == look && meets_target();
    }
    if (film_.fewest_samples() >= settings_.samples) good_enough = meets_target();  // gone on with, with no more to do
    const bool short_of_target = settings_.target > 0 && !good_enough;
    if (checkpoints_.keep && (stopped() || short_of_target || checkpoints_.at_end)) keep();
    if (film_.fewest_samples() == 0) throw core::Interrupted("rendering " + camera_.name);
    Rendering picture = developed();
    picture.relative_error = relative_error();
    picture.met_target = good_enough;
    // Not by the stop flag, which may be raised after the last sample.
    picture.complete = good_enough || picture.samples >= settings_.samples;
    return picture;
  }

 private:
  bool stopped() const { return run_.stop.stop_requested(); }

  /// With a target there is a look at the errors after 64, 128, 256, .. samples a pixel alone: looks are chances to stop
  /// where errors happen to seem small, and few of them are as good as none.
  std::uint64_t next_look(std::uint64_t done) const {
    if (settings_.target == 0) return settings_.samples;
    std::uint64_t look = first_look;
    while (look <= done) look *= 2;
    return std::min(look, settings_.samples);
  }

  /// Errors tell nothing of light that samples may not have met: a picture in which hardly any met it would be the best.
  bool meets_target() const {
    return settings_.target > 0 && relative_error() <= settings_.target &&
           exposure_->may_lack(film_.fewest_samples()).empty();
  }

  /// Of pixels that have found light; those that have not, as where the background is black, tell no noise: the rule of
  /// three, which falls as 1 / n, would be all of the error, and no number of samples enough.
  double relative_error() const {
    const Spectrum largest = inv_pi * exposure_->largest_score();
    std::vector<double> values, errors;
    double of_dark = 0, sum = 0;
    for (std::size_t p = 0; p < film_.pixels(); ++p) {
      if (!in_sight(p)) continue;
      const Estimate pixel = film_.estimate(p, largest);
      const double error = error_of(weighed_standard_error(scene_, pixel), scene_.weigh(pixel.error_bound));
      if (is_dark(scene_, pixel)) {
        of_dark = std::max(of_dark, error);
      } else {
        values.push_back(scene_.weigh(pixel.value));
        errors.push_back(error);
      }
    }
    if (values.empty()) return of_dark > 0 ? std::numeric_limits<double>::infinity() : 0;
    const double floor = 0.1 * std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
    for (std::size_t p = 0; p < values.size(); ++p) sum += std::pow(errors[p] / std::max(values[p], floor), 2);
    return std::sqrt(sum / static_cast<double>(values.size()));
  }

  /// Whether any ray of it sees: else it is exactly 0.
  bool in_sight(std::size_t pixel) const {
    const auto width = static_cast<std::size_t>(camera_.width);
    const Vec2 middle(static_cast<double>(pixel % width) + 0.5, static_cast<double>(pixel / width) + 0.5);
    const Vec2 reach = Vec2::Constant(filter_->reach());
    return map_.in_sight(middle - reach, middle + reach);
  }

  void keep() {
    checkpoints_.keep(film_.state());
    saved_ = Clock::now();
  }

  Rendering developed() const {
    const std::vector<std::string>& channels = scene_.channels;
    const int w = camera_.width, h = camera_.height;
    Rendering picture{{w, h, channels}, {w, h, channels}, {w, h, {"samples"}}, film_.fewest_samples()};
    const Spectrum largest = inv_pi * (1 + 2 * filter_->negative()) * exposure_->largest_score();
    for (int y = 0; y < h; ++y)
      for (int x = 0; x < w; ++x) {
        const std::size_t p = static_cast<std::size_t>(y) * static_cast<std::size_t>(w) + static_cast<std::size_t>(x);
        picture.samples_a_pixel.at(x, y, 0) = static_cast<float>(film_.samples(p));
        if (!in_sight(p)) continue;
        const Estimate pixel = film_.estimate(p, largest);
        picture.report.add(p, film_.tally(p));
        if (is_dark(scene_, pixel)) picture.dark += 1 / static_cast<double>(film_.pixels());
        const Spectrum error = error_of(pixel.standard_error, pixel.error_bound);
        for (int c = 0; c < static_cast<int>(channels.size()); ++c) {
          picture.radiance.at(x, y, c) = static_cast<float>(pixel.value[c]);
          picture.standard_error.at(x, y, c) = static_cast<float>(error[c]);
        }
      }
    picture.report.rare = exposure_->may_lack(film_.fewest_samples());
    picture.report.rare_samples = film_.fewest_samples();
    if (const std::uint64_t not_finite = picture.report.not_finite; not_finite > 0)
      core::log::warning(core::format("render: %llu samples are not finite and count as zero (seed %llu)",
                                      static_cast<unsigned long long>(not_finite),
                                      static_cast<unsigned long long>(run_.seed)));
    return picture;
  }

  const scene::Scene& scene_;
  const RenderSettings& settings_;
  const scene::Camera& camera_;
  scene::FilmMap map_;
  std::unique_ptr<ReconstructionFilter> filter_;
  std::unique_ptr<Exposure> exposure_;
  Run& run_;
  const RenderCheckpoints& checkpoints_;
  Film film_;
  Clock::time_point saved_ = Clock::now();
};

}  // namespace

std::pair<Index, Index> render_state_size(const scene::Scene& scene, scene::CameraId id,
                                          const RenderSettings& settings) {
  return {static_cast<Index>(pixels_of(scene.camera(id))), empty_film(scene, 1, settings).state_columns()};
}

Rendering render(const scene::Scene& scene, scene::CameraId id, const RenderSettings& settings, Run& run,
                 const raycast::RayCaster& caster, const RenderCheckpoints& checkpoints) {
  require_valid(scene, id, settings);
  return Painter(scene, id, settings, run, caster, checkpoints).paint();
}

Rendering render(const scene::Scene& scene, scene::CameraId id, std::uint64_t samples, Run& run,
                 const std::string& intersector) {
  return render(scene, id, samples, run, *raycast::make_ray_caster(intersector, scene));
}

Rendering render(const scene::Scene& scene, scene::CameraId id, std::uint64_t samples, Run& run,
                 const raycast::RayCaster& caster) {
  RenderSettings settings;
  settings.samples = samples;
  return render(scene, id, settings, run, caster);
}

}  // namespace interflect::montecarlo

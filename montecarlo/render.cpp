#include "montecarlo/render.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <memory>

#include "core/error.h"
#include "core/format.h"
#include "core/log.h"
#include "core/sample_sequence.h"
#include "core/seconds_since.h"
#include "montecarlo/film/film.h"
#include "montecarlo/film/reconstruction_filter.h"
#include "montecarlo/measurement_sampler.h"
#include "montecarlo/path_tracer.h"
#include "montecarlo/scene_paths.h"
#include "scene/film_map.h"

namespace interflect::montecarlo {
namespace {

using Clock = std::chrono::steady_clock;

constexpr Index pixels_per_block = 256;
constexpr std::uint64_t first_pass = 4;    ///< samples a pixel
constexpr std::size_t given_numbers = 36;  ///< of a sequence: film 2, lens 2, 8 a vertex

bool independent(const RenderSettings& settings) { return settings.sequence == "independent"; }

void require_valid(const scene::Scene& scene, scene::CameraId id, const RenderSettings& settings) {
  if (id.value >= scene.cameras.size()) throw core::InputError("render", "a camera of the scene expected");
  scene::require_valid(scene.camera(id));
  const measure::Measurement pixel = measure::PixelRadiance{id, 0, 0};
  require_found(PathTracer(), scene, {&pixel, 1}, settings.paths);
  if (settings.samples == 0) throw core::InputError("render", "at least one sample a pixel expected");
  if (!independent(settings) && settings.samples % sequence_batches != 0)
    throw core::InputError("render", core::format("samples of the sequence '%s' come in %d randomisations, which say "
                                                  "how large errors are: a multiple of %d a pixel expected, not %llu",
                                                  settings.sequence.c_str(), sequence_batches, sequence_batches,
                                                  static_cast<unsigned long long>(settings.samples)));
}

std::size_t pixels_of(const scene::Camera& camera) {
  return static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height);
}

Film empty_film(const scene::Scene& scene, const scene::Camera& camera, const RenderSettings& settings) {
  return {pixels_of(camera), scene.channel_count(), independent(settings) ? 0 : sequence_batches};
}

/// How many pixels' samples at once: so many that a stop, or a checkpoint, need not wait for long.  Nothing but time
/// depends on it.
class Pace {
 public:
  std::uint64_t portion() const { return portion_; }
  void took(std::uint64_t samples, double seconds) {
    const double wished = static_cast<double>(samples) * wished_seconds / std::max(seconds, 1e-6);
    portion_ = static_cast<std::uint64_t>(std::clamp(wished, 4096.0, 4 * static_cast<double>(portion_)));
  }

 private:
  static constexpr double wished_seconds = 2;
  std::uint64_t portion_ = 1 << 16;
};

class Painter {
 public:
  Painter(const scene::Scene& scene, scene::CameraId id, const RenderSettings& settings, Run& run,
          const raycast::RayCaster& caster, const RenderCheckpoints& checkpoints)
      : settings_(settings),
        camera_(scene.camera(id)),
        map_(camera_),
        filter_(make_filter(settings.filter)),
        sequence_(core::make_sequence(settings.sequence, core::derived_seed(run.seed, "path tracer sequences"))),
        paths_(scene, caster, settings.paths),
        seed_(core::derived_seed(run.seed, "path tracer pixels")),
        run_(run),
        checkpoints_(checkpoints),
        film_(empty_film(scene, camera_, settings)) {
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
    for (std::uint64_t done = film_.fewest_samples(); done < settings_.samples && !stopped();) done = pass(done, stage);
    if (checkpoints_.keep && (stopped() || kept_ || checkpoints_.from != nullptr)) keep();
    if (film_.fewest_samples() == 0) throw core::Interrupted("rendering " + camera_.name);
    return developed();
  }

 private:
  bool stopped() const { return run_.stop.stop_requested(); }

  /// All pixels from `done` on.  @return  samples that all have then, but for a stop
  std::uint64_t pass(std::uint64_t done, core::Progress::Stage& stage) {
    const std::uint64_t unit = independent(settings_) ? 1 : sequence_batches;
    const std::uint64_t least = std::max(first_pass, unit);
    const std::uint64_t at_once = std::max(least, pace_.portion() / film_.pixels()) / unit * unit;
    const std::uint64_t end = std::min(settings_.samples, done + std::min(std::max(least, done), at_once));
    const std::uint64_t each = end - done;
    for (std::size_t begin = 0; begin < film_.pixels() && !stopped();) {
      const std::size_t band = std::max<std::size_t>(pixels_per_block, pace_.portion() / each);
      const std::size_t past = std::min(film_.pixels(), begin + band);
      const Clock::time_point start = Clock::now();
      run_.threads.for_blocks(static_cast<Index>(past - begin), pixels_per_block, [&](Index from, Index to) {
        if (stopped()) return;
        for (Index p = from; p < to; ++p) expose(begin + static_cast<std::size_t>(p), end);
        stage.advance(static_cast<std::uint64_t>(to - from) * each);
      });
      pace_.took((past - begin) * each, core::seconds_since(start));
      begin = past;
      if (checkpoints_.keep && core::seconds_since(saved_) >= checkpoints_.seconds_between) keep();
    }
    return end;
  }

  void keep() {
    checkpoints_.keep(film_.state());
    kept_ = true;
    saved_ = Clock::now();
  }

  void add(std::size_t pixel, core::RandomNumbers& numbers) {
    const auto width = static_cast<std::size_t>(camera_.width);
    const PixelOnFilm at{static_cast<int>(pixel % width), static_cast<int>(pixel / width)};
    const Spectrum sample = film_sample(map_, *filter_, at, paths_, numbers);
    film_.add(pixel, sample, paths_.scene().weigh(sample));
  }

  /// Brings a pixel to `end` samples.
  void expose(std::size_t pixel, std::uint64_t end) {
    const std::uint64_t begin = film_.samples(pixel);
    if (begin >= end) return;  // of a run that had come further here before it was stopped
    const auto stream = static_cast<std::uint32_t>(pixel);
    if (independent(settings_)) {
      for (std::uint64_t k = begin; k < end; ++k) {
        core::RandomNumbers numbers(seed_, stream, k);
        add(pixel, numbers);
      }
      return;
    }
    const std::size_t rounds = static_cast<std::size_t>((end - begin) / sequence_batches);
    std::vector<double> points(sequence_batches * rounds * given_numbers);
    for (std::size_t b = 0; b < sequence_batches; ++b)
      sequence_->replicate(pixel * sequence_batches + b)
          ->points(begin / sequence_batches, given_numbers,
                   std::span(points).subspan(b * rounds * given_numbers, rounds * given_numbers));
    for (std::uint64_t k = begin; k < end; ++k) {
      const std::size_t b = k % sequence_batches, round = static_cast<std::size_t>((k - begin) / sequence_batches);
      core::RandomNumbers numbers(seed_, stream, k,
                                  std::span(points).subspan((b * rounds + round) * given_numbers, given_numbers));
      add(pixel, numbers);
    }
  }

  Rendering developed() const {
    const std::vector<std::string>& channels = paths_.scene().channels;
    const int w = camera_.width, h = camera_.height;
    Rendering picture{{w, h, channels}, {w, h, channels}, {w, h, {"samples"}}, film_.fewest_samples()};
    const Spectrum largest = inv_pi * (1 + 2 * filter_->negative()) * paths_.largest_score();
    for (int y = 0; y < h; ++y)
      for (int x = 0; x < w; ++x) {
        const std::size_t p = static_cast<std::size_t>(y) * static_cast<std::size_t>(w) + static_cast<std::size_t>(x);
        picture.samples_a_pixel.at(x, y, 0) = static_cast<float>(film_.samples(p));
        const Vec2 middle(x + 0.5, y + 0.5), reach = Vec2::Constant(filter_->reach());
        if (!map_.in_sight(middle - reach, middle + reach)) continue;  // exactly 0
        const Estimate pixel = film_.estimate(p, largest);
        for (int c = 0; c < static_cast<int>(channels.size()); ++c) {
          picture.radiance.at(x, y, c) = static_cast<float>(pixel.value[c]);
          picture.standard_error.at(x, y, c) = static_cast<float>(pixel.standard_error[c]);
        }
      }
    if (const std::uint64_t not_finite = film_.not_finite(); not_finite > 0)
      core::log::warning(core::format("render: %llu samples are not finite and count as zero (seed %llu)",
                                      static_cast<unsigned long long>(not_finite),
                                      static_cast<unsigned long long>(seed_)));
    return picture;
  }

  const RenderSettings& settings_;
  const scene::Camera& camera_;
  scene::FilmMap map_;
  std::unique_ptr<ReconstructionFilter> filter_;
  std::unique_ptr<core::SampleSequence> sequence_;
  PathEstimator paths_;
  std::uint64_t seed_;
  Run& run_;
  const RenderCheckpoints& checkpoints_;
  Film film_;
  Pace pace_;
  Clock::time_point saved_ = Clock::now();
  bool kept_ = false;
};

}  // namespace

std::pair<Index, Index> render_state_size(const scene::Scene& scene, scene::CameraId id,
                                          const RenderSettings& settings) {
  const Film one_pixel(1, scene.channel_count(), independent(settings) ? 0 : sequence_batches);
  return {static_cast<Index>(pixels_of(scene.camera(id))), one_pixel.state_columns()};
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

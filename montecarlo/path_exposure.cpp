#include "montecarlo/path_exposure.h"

#include <algorithm>
#include <chrono>

#include "core/sample_sequence.h"
#include "core/seconds_since.h"
#include "montecarlo/measurement_sampler.h"

namespace interflect::montecarlo {
namespace {

using Clock = std::chrono::steady_clock;

constexpr Index pixels_per_block = 256;
constexpr std::uint64_t first_pass = 4;    ///< samples a pixel
constexpr std::size_t given_numbers = 36;  ///< of a sequence: film 2, lens 2, 8 a vertex

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

class PathExposure final : public Exposure {
 public:
  PathExposure(const scene::Scene& scene, const scene::Camera& camera, const RenderSettings& settings,
               const ReconstructionFilter& filter, const raycast::RayCaster& caster, Run& run)
      : settings_(settings),
        camera_(camera),
        map_(camera),
        filter_(filter),
        sequence_(core::make_sequence(settings.sequence, core::derived_seed(run.seed, "path tracer sequences"))),
        paths_(scene, caster, settings.paths),
        seed_(core::derived_seed(run.seed, "path tracer pixels")),
        run_(run) {}

  Spectrum largest_score() const override { return paths_.largest_score(); }

  std::uint64_t pass(Film& film, std::uint64_t done, std::uint64_t limit, core::Progress::Stage& stage,
                     const std::function<void()>& after_some) override {
    const std::uint64_t unit = settings_.independent() ? 1 : sequence_batches;
    const std::uint64_t least = std::max(first_pass, unit);
    const std::uint64_t at_once = std::max(least, pace_.portion() / film.pixels()) / unit * unit;
    const std::uint64_t end = std::min(limit, done + std::min(std::max(least, done), at_once));
    const std::uint64_t each = end - done;
    for (std::size_t begin = 0; begin < film.pixels() && !run_.stop.stop_requested();) {
      const std::size_t band = std::max<std::size_t>(pixels_per_block, pace_.portion() / each);
      const std::size_t past = std::min(film.pixels(), begin + band);
      const Clock::time_point start = Clock::now();
      run_.threads.for_blocks(static_cast<Index>(past - begin), pixels_per_block, [&](Index from, Index to) {
        if (run_.stop.stop_requested()) return;
        for (Index p = from; p < to; ++p) expose(film, begin + static_cast<std::size_t>(p), end);
        stage.advance(static_cast<std::uint64_t>(to - from) * each);
      });
      pace_.took((past - begin) * each, core::seconds_since(start));
      begin = past;
      after_some();
    }
    return end;
  }

 private:
  PixelOnFilm place_of(std::size_t pixel) const {
    const auto width = static_cast<std::size_t>(camera_.width);
    return {static_cast<int>(pixel % width), static_cast<int>(pixel / width)};
  }
  void add(Film& film, std::size_t pixel, core::RandomNumbers& numbers) {
    const Spectrum sample = film_sample(map_, filter_, place_of(pixel), paths_, numbers);
    film.add(pixel, sample, paths_.scene().weigh(sample));
  }

  /// Brings a pixel to `end` samples.
  void expose(Film& film, std::size_t pixel, std::uint64_t end) {
    const std::uint64_t begin = film.samples(pixel);
    if (begin >= end) return;  // of a run that had come further here before it was stopped
    const auto stream = static_cast<std::uint32_t>(pixel);
    if (settings_.independent()) {
      std::vector<Spectrum> samples(end - begin);
      film_samples(map_, filter_, place_of(pixel), paths_, {seed_, stream, begin}, samples);
      for (const Spectrum& sample : samples) film.add(pixel, sample, paths_.scene().weigh(sample));
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
      add(film, pixel, numbers);
    }
  }

  const RenderSettings& settings_;
  const scene::Camera& camera_;
  scene::FilmMap map_;
  const ReconstructionFilter& filter_;
  std::unique_ptr<core::SampleSequence> sequence_;
  PathEstimator paths_;
  std::uint64_t seed_;
  Run& run_;
  Pace pace_;
};

}  // namespace

std::unique_ptr<Exposure> path_exposure(const scene::Scene& scene, const scene::Camera& camera,
                                        const RenderSettings& settings, const ReconstructionFilter& filter,
                                        const raycast::RayCaster& caster, Run& run) {
  return std::make_unique<PathExposure>(scene, camera, settings, filter, caster, run);
}

}  // namespace interflect::montecarlo

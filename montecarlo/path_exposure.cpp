#include "montecarlo/path_exposure.h"

#include "core/sample_sequence.h"
#include "montecarlo/measurement_sampler.h"
#include "montecarlo/pixel_exposure.h"
#include "montecarlo/render.h"

namespace interflect::montecarlo {
namespace {

/// Of a sequence: of the film 2, of the lens 2 where there is one, of the first vertex 8, and what is left of the second.
/// Those of further ones gain 3 % of the variance in the Cornell box, and take nearly as long as the path does.
constexpr std::size_t given_numbers = 12;

class PathExposure final : public PixelExposure {
 public:
  PathExposure(const scene::Scene& scene, const scene::Camera& camera, const RenderSettings& settings,
               const ReconstructionFilter& filter, const raycast::RayCaster& caster, Run& run, NextEvent next_event)
      : PixelExposure(settings.independent() ? 1 : sequence_batches, run),
        settings_(settings),
        camera_(camera),
        map_(camera),
        filter_(filter),
        sequence_(core::make_sequence(settings.sequence, core::derived_seed(run.seed, "path tracer sequences"))),
        paths_(scene, caster, settings.paths, next_event),
        seed_(core::derived_seed(run.seed, path_tracer_name(next_event) + " pixels")) {}

  Spectrum largest_score() const override { return paths_.largest_score(); }
  std::string may_lack(std::uint64_t samples) const override { return paths_.rare_lights().of_picture(samples); }

 private:
  PixelOnFilm place_of(std::size_t pixel) const {
    const auto width = static_cast<std::size_t>(camera_.width);
    return {static_cast<int>(pixel % width), static_cast<int>(pixel / width)};
  }

  void expose(Film& film, std::size_t pixel, std::uint64_t begin, std::uint64_t end) override {
    PathEstimator::Keys keys{seed_, static_cast<std::uint32_t>(pixel), begin};
    std::vector<double> points;
    if (!settings_.independent()) {
      points = points_of(pixel, begin, end);
      keys.given = points, keys.given_each = given_numbers;
    }
    std::vector<Spectrum> samples(end - begin);
    film_samples(map_, filter_, place_of(pixel), paths_, keys, samples);
    for (const Spectrum& sample : samples) film.add(pixel, sample, paths_.scene().weigh(sample));
  }

  /// Of a sequence the numbers of samples begin .. end - 1, whose k-th is of randomisation k mod sequence_batches.
  std::vector<double> points_of(std::size_t pixel, std::uint64_t begin, std::uint64_t end) const {
    const auto rounds = static_cast<std::size_t>((end - begin) / sequence_batches);
    std::vector<double> points(sequence_batches * rounds * given_numbers), of_one(rounds * given_numbers);
    for (std::size_t b = 0; b < sequence_batches; ++b) {
      sequence_->replicate(pixel * sequence_batches + b)->points(begin / sequence_batches, given_numbers, of_one);
      for (std::size_t round = 0; round < rounds; ++round)
        std::copy_n(&of_one[round * given_numbers], given_numbers,
                    &points[(round * sequence_batches + b) * given_numbers]);
    }
    return points;
  }

  const RenderSettings& settings_;
  const scene::Camera& camera_;
  scene::FilmMap map_;
  const ReconstructionFilter& filter_;
  std::unique_ptr<core::SampleSequence> sequence_;
  PathEstimator paths_;
  std::uint64_t seed_;
};

}  // namespace

std::unique_ptr<Exposure> path_exposure(const scene::Scene& scene, const scene::Camera& camera,
                                        const RenderSettings& settings, const ReconstructionFilter& filter,
                                        const raycast::RayCaster& caster, Run& run) {
  return std::make_unique<PathExposure>(scene, camera, settings, filter, caster, run, NextEvent::yes);
}

std::unique_ptr<Exposure> unidirectional_exposure(const scene::Scene& scene, const scene::Camera& camera,
                                                  const RenderSettings& settings, const ReconstructionFilter& filter,
                                                  const raycast::RayCaster& caster, Run& run) {
  return std::make_unique<PathExposure>(scene, camera, settings, filter, caster, run, NextEvent::no);
}

}  // namespace interflect::montecarlo

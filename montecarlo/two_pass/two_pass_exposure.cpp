#include "core/estimate.h"
#include "core/random.h"
#include "montecarlo/film/filtered.h"
#include "montecarlo/measurement_sampler.h"
#include "montecarlo/pixel_exposure.h"
#include "montecarlo/render.h"
#include "montecarlo/two_pass/two_pass.h"
#include "montecarlo/two_pass/two_pass_estimator.h"
#include "scene/film_map.h"

namespace interflect::montecarlo {
namespace {

constexpr std::uint32_t film_block = 0, lens_block = 1, walk_block = 2, second_walk_block = 1u << 30;

class TwoPassExposure final : public PixelExposure {
 public:
  TwoPassExposure(const scene::Scene& scene, const scene::Camera& camera, const RenderSettings& settings,
                  const ReconstructionFilter& filter, const raycast::RayCaster& caster, Run& run)
      : PixelExposure(1, run),
        settings_(settings),
        camera_(camera),
        map_(camera),
        filter_(filter),
        passes_(scene, caster, 1),
        traced_(core::derived_seed(run.seed, "two-pass pixels, traced")),
        asked_(core::derived_seed(run.seed, "two-pass pixels, of the solution")) {
    require_two_passes(scene, settings.solution, settings.paths);
  }

  Spectrum largest_score() const override { return passes_.paths().largest_score(); }
  std::string may_lack(std::uint64_t samples) const override {
    return passes_.paths().rare_lights().of_picture(samples);
  }

 private:
  void expose(Film& film, std::size_t pixel, std::uint64_t begin, std::uint64_t end) override {
    const auto width = static_cast<std::size_t>(camera_.width);
    const auto stream = static_cast<std::uint32_t>(pixel);
    std::vector<Spectrum> samples(end - begin);
    film_samples(map_, filter_, {static_cast<int>(pixel % width), static_cast<int>(pixel / width)}, passes_.paths(),
                 {traced_, stream, begin}, samples);
    for (std::size_t k = 0; k < samples.size(); ++k) {
      Spectrum error;
      samples[k] += of_solution(pixel, {asked_, stream, begin + k}, error);
      film.add(pixel, samples[k], passes_.paths().scene().weigh(samples[k]));
      film.leave_out(pixel, error);
    }
  }

  /// @param error  what the solution may err by there, its noise and all
  Spectrum of_solution(std::size_t pixel, core::RandomNumbers numbers, Spectrum& error) const {
    numbers.jump(film_block);
    const double u = numbers.next(), v = numbers.next();
    numbers.jump(lens_block);
    const double r = numbers.next(), turn = numbers.next();
    return filtered(filter_, middle_of(camera_, pixel), u, v, [&](const Vec2& at, bool second) {
      const auto ray = map_.ray(at, scene::uniform_disk(r, turn));
      if (!ray) return Spectrum::zero();
      const TwoPassEstimator::Walked walked =
          passes_.radiance({ray->origin, ray->direction}, numbers, second ? second_walk_block : walk_block);
      const double counts = second ? filter_.negative() : 1 + filter_.negative();
      const Answered answer = answered(settings_.solution, walked);
      error += counts * (answer.bound + normal_95 * (answer.own_noise + answer.shared_noise));
      return answer.value;
    });
  }

  const RenderSettings& settings_;
  const scene::Camera& camera_;
  scene::FilmMap map_;
  const ReconstructionFilter& filter_;
  TwoPassEstimator passes_;
  std::uint64_t traced_, asked_;
};

}  // namespace

std::unique_ptr<Exposure> two_pass_exposure(const scene::Scene& scene, const scene::Camera& camera,
                                            const RenderSettings& settings, const ReconstructionFilter& filter,
                                            const raycast::RayCaster& caster, Run& run) {
  return std::make_unique<TwoPassExposure>(scene, camera, settings, filter, caster, run);
}

}  // namespace interflect::montecarlo

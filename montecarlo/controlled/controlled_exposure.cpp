#include <memory>
#include <vector>

#include "core/control_variate.h"
#include "montecarlo/controlled/controlled.h"
#include "montecarlo/controlled/controlled_paths.h"
#include "montecarlo/measurement_sampler.h"
#include "montecarlo/pixel_exposure.h"
#include "montecarlo/render.h"
#include "scene/film_map.h"

namespace interflect::montecarlo {
namespace {

class ControlledExposure final : public PixelExposure {
 public:
  ControlledExposure(const scene::Scene& scene, const scene::Camera& camera, const RenderSettings& settings,
                     const ReconstructionFilter& filter, const raycast::RayCaster& caster, Run& run)
      : PixelExposure(1, run),
        width_(static_cast<std::size_t>(camera.width)),
        map_(camera),
        filter_(filter),
        paths_(scene, caster, settings.solution, settings.paths),
        seed_(core::derived_seed(run.seed, "controlled pixels")) {
    require_known(settings.solution);
    c_ = factor_of_pilot(width_ * static_cast<std::size_t>(camera.height),
                         core::derived_seed(run.seed, "controlled pixels, pilot"));
  }

  Spectrum largest_score() const override { return paths_.largest_score(); }
  std::string may_lack(std::uint64_t samples) const override {
    return paths_.paths().rare_lights().of_picture(samples);
  }

 private:
  /// Samples of a pixel by their radiances.
  template <class Radiances>
  void see(std::size_t pixel, const PathEstimator::Keys& keys, const Radiances& radiances,
           std::span<Spectrum> samples) const {
    film_samples(map_, filter_, {static_cast<int>(pixel % width_), static_cast<int>(pixel / width_)}, radiances, keys,
                 samples);
  }

  void expose(Film& film, std::size_t pixel, std::uint64_t begin, std::uint64_t end) override {
    const PathEstimator::Keys keys{seed_, static_cast<std::uint32_t>(pixel), begin};
    std::vector<Spectrum> samples(end - begin), light(samples.size());
    std::vector<ControlledPaths::Found> all(samples.size());
    const auto radiances = [&](auto rays, std::uint32_t block, auto found) {
      paths_.radiance(rays, keys, block, all);
      for (std::size_t k = 0; k < all.size(); ++k) found[k] = all[k].by(c_), light[k] += all[k].path;
    };
    see(pixel, keys, radiances, samples);
    const scene::Scene& scene = paths_.paths().scene();
    for (std::size_t k = 0; k < samples.size(); ++k) film.add(pixel, samples[k], scene.weigh(samples[k]), light[k]);
  }

  /// By some paths of some pixels all over the film, which are not used again.
  double factor_of_pilot(std::size_t pixels, std::uint64_t seed) const {
    constexpr std::size_t most_pixels = 512, paths_each = 8;
    const std::size_t some = std::min(pixels, most_pixels);
    const scene::Scene& scene = paths_.paths().scene();
    core::ControlVariate pilot(0, 3);
    std::vector<Spectrum> ignored(paths_each);
    std::vector<ControlledPaths::Found> all(paths_each);
    for (std::size_t k = 0; k < some; ++k) {
      const std::size_t pixel = k * pixels / some;
      const PathEstimator::Keys keys{seed, static_cast<std::uint32_t>(pixel), 0};
      const auto radiances = [&](auto rays, std::uint32_t block, auto) {
        paths_.radiance(rays, keys, block, all);
        for (const auto& each : all) pilot.add(scene.weigh(each.path), scene.weigh(each.control));
      };
      see(pixel, keys, radiances, ignored);
    }
    return control_factor(pilot);
  }

  std::size_t width_;
  scene::FilmMap map_;
  const ReconstructionFilter& filter_;
  ControlledPaths paths_;
  std::uint64_t seed_;
  double c_ = 1;
};

}  // namespace

std::unique_ptr<Exposure> controlled_exposure(const scene::Scene& scene, const scene::Camera& camera,
                                              const RenderSettings& settings, const ReconstructionFilter& filter,
                                              const raycast::RayCaster& caster, Run& run) {
  return std::make_unique<ControlledExposure>(scene, camera, settings, filter, caster, run);
}

}  // namespace interflect::montecarlo

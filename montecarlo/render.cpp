#include "montecarlo/render.h"

#include <algorithm>

#include "core/error.h"
#include "core/format.h"
#include "core/log.h"
#include "montecarlo/measurement_sampler.h"
#include "montecarlo/tally.h"

namespace interflect::montecarlo {

namespace {

constexpr Index pixels_per_block = 256;
constexpr std::uint64_t first_pass = 4;  ///< samples a pixel

/// The samples of every pixel, row by row.
class Film {
 public:
  Film(const scene::Camera& camera, const PathEstimator& paths, std::uint64_t seed)
      : camera_(camera),
        paths_(paths),
        seed_(seed),
        tallies_(static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height)) {}

  /// Brings every pixel from `first` to `end` samples; a stopped run leaves some where they are.
  void expose(std::uint64_t first, std::uint64_t end, Run& run, core::Progress::Stage& stage) {
    run.threads.for_blocks(static_cast<Index>(tallies_.size()), pixels_per_block, [&](Index begin, Index past) {
      if (run.stop.stop_requested()) return;
      for (auto p = static_cast<std::uint32_t>(begin); p < static_cast<std::uint32_t>(past); ++p)
        for (std::uint64_t k = first; k < end; ++k) {
          core::RandomNumbers numbers(seed_, p, k);
          const auto width = static_cast<std::uint32_t>(camera_.width);
          const Spectrum sample =
              pixel_sample(camera_, static_cast<int>(p % width), static_cast<int>(p / width), paths_, numbers);
          tallies_[p].add(sample, paths_.scene().weigh(sample), k);
        }
      stage.advance(static_cast<std::uint64_t>(past - begin) * (end - first));
    });
  }

  std::uint64_t fewest_samples() const {
    const auto fewer = [](const Tally& a, const Tally& b) { return a.moments.count() < b.moments.count(); };
    return std::min_element(tallies_.begin(), tallies_.end(), fewer)->moments.count();
  }

  Rendering developed(const std::vector<std::string>& channels) const {
    Rendering picture{
        {camera_.width, camera_.height, channels}, {camera_.width, camera_.height, channels}, fewest_samples()};
    const Spectrum largest = inv_pi * paths_.largest_score();
    std::uint64_t not_finite = 0;
    for (std::size_t p = 0; p < tallies_.size(); ++p) {
      const Estimate pixel = tallies_[p].estimate(largest);
      not_finite += tallies_[p].not_finite;
      for (std::size_t c = 0; c < channels.size(); ++c) {
        picture.radiance.data[p * channels.size() + c] = static_cast<float>(pixel.value[static_cast<int>(c)]);
        picture.standard_error.data[p * channels.size() + c] =
            static_cast<float>(pixel.standard_error[static_cast<int>(c)]);
      }
    }
    if (not_finite > 0)
      core::log::warning(core::format("render: %llu samples are not finite and count as zero (seed %llu)",
                                      static_cast<unsigned long long>(not_finite),
                                      static_cast<unsigned long long>(seed_)));
    return picture;
  }

 private:
  const scene::Camera& camera_;
  const PathEstimator& paths_;
  std::uint64_t seed_;
  std::vector<Tally> tallies_;
};

}  // namespace

Rendering render(const scene::Scene& scene, scene::CameraId id, std::uint64_t samples, Run& run,
                 const std::string& intersector) {
  return render(scene, id, samples, run, *raycast::make_ray_caster(intersector, scene));
}

Rendering render(const scene::Scene& scene, scene::CameraId id, std::uint64_t samples, Run& run,
                 const raycast::RayCaster& caster) {
  if (id.value >= scene.cameras.size()) throw core::InputError("render", "a camera of the scene expected");
  if (samples == 0) throw core::InputError("render", "at least one sample a pixel expected");
  const scene::Camera& camera = scene.camera(id);
  const PathEstimator paths(scene, caster);
  Film film(camera, paths, core::derived_seed(run.seed, "path tracer pixels"));
  core::Progress::Stage stage(
      run.progress, "rendering " + camera.name,
      samples * static_cast<std::uint64_t>(camera.width) * static_cast<std::uint64_t>(camera.height));
  for (std::uint64_t done = 0; done < samples && !run.stop.stop_requested();) {
    const std::uint64_t next = std::min(samples, std::max(first_pass, 2 * done));
    film.expose(done, next, run, stage);
    done = next;
  }
  if (film.fewest_samples() == 0) throw core::Interrupted("rendering " + camera.name);
  return film.developed(scene.channels);
}

}  // namespace interflect::montecarlo

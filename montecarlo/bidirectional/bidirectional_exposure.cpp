#include "montecarlo/bidirectional/bidirectional_exposure.h"

#include <numeric>

#include "montecarlo/bidirectional/bidirectional_film.h"
#include "montecarlo/render.h"
#include "montecarlo/sweep_exposure.h"

namespace interflect::montecarlo {
namespace {

std::vector<std::uint32_t> all_pixels(const scene::Camera& camera) {
  std::vector<std::uint32_t> pixels(static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height));
  std::iota(pixels.begin(), pixels.end(), 0u);
  return pixels;
}

class BidirectionalExposure final : public SweepExposure {
 public:
  BidirectionalExposure(const scene::Scene& scene, const scene::Camera& camera, const RenderSettings& settings,
                        const ReconstructionFilter& filter, const raycast::RayCaster& caster, Run& run)
      : SweepExposure(scene, run),
        walks_(scene, caster, settings.paths),
        sweeps_(walks_, camera, all_pixels(camera), filter, core::derived_seed(run.seed, "bidirectional pixels")) {}

  Spectrum largest_score() const override { return walks_.largest_score(); }

 private:
  const Sweeps& sweeps() const override { return sweeps_; }
  bool dark() const override { return walks_.dark(); }

  BidirectionalEstimator walks_;
  BidirectionalFilm sweeps_;
};

}  // namespace

std::unique_ptr<Exposure> bidirectional_exposure(const scene::Scene& scene, const scene::Camera& camera,
                                                 const RenderSettings& settings, const ReconstructionFilter& filter,
                                                 const raycast::RayCaster& caster, Run& run) {
  return std::make_unique<BidirectionalExposure>(scene, camera, settings, filter, caster, run);
}

}  // namespace interflect::montecarlo

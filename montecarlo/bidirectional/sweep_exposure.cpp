#include "montecarlo/bidirectional/sweep_exposure.h"

#include <algorithm>
#include <numeric>

#include "montecarlo/bidirectional/bidirectional_film.h"

namespace interflect::montecarlo {
namespace {

std::vector<std::uint32_t> all_pixels(const scene::Camera& camera) {
  std::vector<std::uint32_t> pixels(static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height));
  std::iota(pixels.begin(), pixels.end(), 0u);
  return pixels;
}

class SweepExposure final : public Exposure {
 public:
  SweepExposure(const scene::Scene& scene, const scene::Camera& camera, const RenderSettings& settings,
                const ReconstructionFilter& filter, const raycast::RayCaster& caster, Run& run)
      : walks_(scene, caster, settings.paths),
        sweeps_(walks_, camera, all_pixels(camera), filter, core::derived_seed(run.seed, "bidirectional pixels")),
        run_(run) {}

  Spectrum largest_score() const override { return walks_.largest_score(); }

  std::uint64_t pass(Film& film, std::uint64_t done, std::uint64_t limit, core::Progress::Stage& stage,
                     const std::function<void()>& after_some) override {
    const std::uint64_t end = std::min(limit, done + sweeps_.sweeps_at_once());
    std::vector<Spectrum> samples((end - done) * sweeps_.pixels());
    if (!walks_.dark()) samples = sweeps_.samples(done, end, run_);
    if (samples.empty()) return done;  // stopped within a sweep
    for (std::size_t s = 0; s < samples.size(); ++s)
      film.add(s % sweeps_.pixels(), samples[s], walks_.scene().weigh(samples[s]));
    stage.advance(samples.size());
    after_some();
    return end;
  }

 private:
  BidirectionalEstimator walks_;
  BidirectionalFilm sweeps_;
  Run& run_;
};

}  // namespace

std::unique_ptr<Exposure> sweep_exposure(const scene::Scene& scene, const scene::Camera& camera,
                                         const RenderSettings& settings, const ReconstructionFilter& filter,
                                         const raycast::RayCaster& caster, Run& run) {
  return std::make_unique<SweepExposure>(scene, camera, settings, filter, caster, run);
}

}  // namespace interflect::montecarlo

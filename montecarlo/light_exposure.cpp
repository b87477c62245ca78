#include "montecarlo/light_exposure.h"

#include "montecarlo/light_paths.h"
#include "montecarlo/render.h"
#include "montecarlo/sweep_exposure.h"

namespace interflect::montecarlo {
namespace {

class LightSweeps final : public Sweeps {
 public:
  LightSweeps(const LightPaths& paths, std::size_t pixels, std::uint64_t seed)
      : paths_(paths), pixels_(pixels), seed_(seed) {}
  std::size_t pixels() const override { return pixels_; }

 private:
  void sweep(std::uint64_t k, std::size_t begin, std::size_t end, std::span<Spectrum>,
             Deposits& deposits) const override {
    montecarlo::Deposits of_path;
    for (std::size_t path = begin; path < end; ++path) {
      core::RandomNumbers numbers(seed_, static_cast<std::uint32_t>(path), k);
      of_path.clear();
      paths_.trace(numbers, of_path);
      for (const auto& [pixel, value] : of_path.of())
        deposits.emplace_back(pixel, value / static_cast<double>(pixels_));
    }
  }

  const LightPaths& paths_;
  std::size_t pixels_;
  std::uint64_t seed_;
};

class LightExposure final : public SweepExposure {
 public:
  LightExposure(const scene::Scene& scene, const scene::Camera& camera, const RenderSettings& settings,
                const ReconstructionFilter& filter, const raycast::RayCaster& caster, Run& run)
      : SweepExposure(scene, run),
        paths_(scene, SplatTargets(camera, filter), caster, settings.paths),
        sweeps_(paths_, static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height),
                core::derived_seed(run.seed, "light tracer pixels")) {}

  Spectrum largest_score() const override { return paths_.lights().largest_find(); }

 private:
  const Sweeps& sweeps() const override { return sweeps_; }
  bool dark() const override { return paths_.dark(); }

  LightPaths paths_;
  LightSweeps sweeps_;
};

}  // namespace

std::unique_ptr<Exposure> light_exposure(const scene::Scene& scene, const scene::Camera& camera,
                                         const RenderSettings& settings, const ReconstructionFilter& filter,
                                         const raycast::RayCaster& caster, Run& run) {
  return std::make_unique<LightExposure>(scene, camera, settings, filter, caster, run);
}

}  // namespace interflect::montecarlo

#pragma once

#include <functional>
#include <memory>
#include <string>

#include "core/run.h"
#include "montecarlo/film/film.h"
#include "montecarlo/film/reconstruction_filter.h"
#include "raycast/ray_caster.h"
#include "scene/scene.h"

namespace interflect::montecarlo {

/// How an integrator exposes a film: the samples of a picture's pixels, in an order of its own.
class Exposure {
 public:
  virtual ~Exposure() = default;
  /// Of an irradiance of 1, as Tally::estimate takes it.
  virtual Spectrum largest_score() const = 0;
  /// Of so many samples a pixel, in words: light that they may not have met, which is in no error; empty where there is
  /// none.
  virtual std::string may_lack(std::uint64_t /*samples*/) const { return {}; }
  /// More samples of all pixels, which have `done` each or, after a stop, some more; up to `limit`.
  /// @param after_some  called now and then, between samples
  /// @return            samples that all have then, but for a stop
  virtual std::uint64_t pass(Film& film, std::uint64_t done, std::uint64_t limit, core::Progress::Stage& stage,
                             const std::function<void()>& after_some) = 0;
};

struct RenderSettings;

/// All must outlive it.
using MakeExposure = std::unique_ptr<Exposure>(const scene::Scene& scene, const scene::Camera& camera,
                                               const RenderSettings& settings, const ReconstructionFilter& filter,
                                               const raycast::RayCaster& caster, Run& run);

}  // namespace interflect::montecarlo

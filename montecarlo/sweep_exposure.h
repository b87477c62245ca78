#pragma once

#include "montecarlo/exposure.h"
#include "montecarlo/film/sweeps.h"

namespace interflect::montecarlo {

/// Sweep by sweep over all pixels, which have as many samples then; a stop leaves whole sweeps.
class SweepExposure : public Exposure {
 public:
  /// Both must outlive it.
  SweepExposure(const scene::Scene& scene, Run& run) : scene_(scene), run_(run) {}
  std::uint64_t pass(Film& film, std::uint64_t done, std::uint64_t limit, core::Progress::Stage& stage,
                     const std::function<void()>& after_some) final;

 private:
  virtual const Sweeps& sweeps() const = 0;
  virtual bool dark() const = 0;  ///< there is nothing that sweeps could find

  const scene::Scene& scene_;
  Run& run_;
};

}  // namespace interflect::montecarlo

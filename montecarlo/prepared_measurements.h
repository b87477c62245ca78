#pragma once

#include <span>
#include <utility>
#include <vector>

#include "montecarlo/measurement_sampler.h"
#include "montecarlo/sampling.h"

namespace interflect::montecarlo {

/// Measurements made ready to be sampled from where they are taken, by light that chance alone may meet: what all
/// integrators of that kind say alike.  Each adds its names, its largest score and its samples.
class PreparedMeasurements : public SampledMeasurements {
 public:
  /// The scene must outlive them.
  /// @throws core::InputError  as MeasurementSampler
  PreparedMeasurements(const scene::Scene& scene, std::span<const measure::Measurement> asked, RareLights rare)
      : scene_(scene), box_(scene.box()), rare_(std::move(rare)) {
    measured_.reserve(asked.size());
    for (const measure::Measurement& each : asked) measured_.emplace_back(scene, each);
  }
  const scene::Scene& scene() const final { return scene_; }
  std::size_t size() const final { return measured_.size(); }
  double scale(std::size_t m) const final { return measured_[m].scale(); }
  const RareLights& rare_lights() const final { return rare_; }
  RareLights::From looks_from(std::size_t m) const override {
    return {measured_[m].is_pixel() ? box_ : measured_[m].box(), measured_[m].is_pixel()};
  }

 protected:
  const MeasurementSampler& measured(std::size_t m) const { return measured_[m]; }

 private:
  const scene::Scene& scene_;
  geometry::Box box_;
  RareLights rare_;
  std::vector<MeasurementSampler> measured_;
};

}  // namespace interflect::montecarlo

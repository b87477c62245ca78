#pragma once

#include <vector>

#include "core/hemisphere.h"
#include "fem/form_factor/element_locator.h"
#include "fem/form_factor/uniform_map.h"
#include "raycast/ray_caster.h"
#include "solvers/transition_sampler.h"

namespace interflect::fem {

/// Transitions between constants on elements by rays: a uniform point of the element, a direction with the density cos /
/// pi, and the element that it meets,
///
///   P(i to j) = 1/A_i int_i int_j cos cos V / (pi r²) = F_ij,     exactly, whatever hides what
///
/// Four numbers a draw: two for the place, two for the direction.
/// Test: tests/fem/ray_transitions.cpp
class RayTransitions final : public solvers::TransitionSampler {
 public:
  /// Both outlive this.
  RayTransitions(std::span<const scene::SurfacePatch> patches, const raycast::RayCaster& rays);
  int dimensions() const override { return 4; }
  std::optional<Index> from_element(Index i, std::span<const double> u) const override;

 private:
  const raycast::RayCaster& rays_;
  ElementLocator locate_;
  struct Sender {
    UniformMap map;
    core::Frame frame;
  };
  std::vector<Sender> senders_;
};

}  // namespace interflect::fem

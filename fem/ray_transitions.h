#pragma once

#include <vector>

#include "core/hemisphere.h"
#include "fem/form_factor/element_locator.h"
#include "fem/form_factor/lines_through.h"
#include "fem/form_factor/uniform_map.h"
#include "fem/space/plane_basis.h"
#include "raycast/ray_caster.h"
#include "solvers/transition_sampler.h"

namespace interflect::fem {

/// Transitions between elements by rays: a uniform point of the element, a direction with the density cos / pi, and the
/// element that it meets,
///
///   P(i to j) = 1/A_i int_i int_j cos cos V / (pi r²) = F_ij,     exactly, whatever hides what
///
/// Four numbers a draw: two for the place, two for the direction.  Points have the polynomials of an order
/// (space/plane_basis.h); lines are those of lines_through.h.
/// Test: tests/fem/ray_transitions.cpp
class RayTransitions final : public solvers::TransitionSampler, public solvers::PointTransitions {
 public:
  /// Both outlive this.
  RayTransitions(std::span<const scene::SurfacePatch> patches, const raycast::RayCaster& rays, int order = 0);
  RayTransitions(const RayTransitions&) = delete;  // lines refer to what is here
  RayTransitions& operator=(const RayTransitions&) = delete;
  int dimensions() const override { return 4; }
  std::optional<Index> from_element(Index i, std::span<const double> u) const override;
  void from_elements(std::span<const Index> from, std::span<const double> u, std::span<Index> arrived) const override;
  const PointTransitions* points() const override { return this; }
  const solvers::LineExchanges* lines() const override { return &lines_; }

  int functions() const override { return functions_; }
  double area(Index element) const override { return areas_[static_cast<std::size_t>(element)]; }
  Point point_on(Index element, std::span<const double> u) const override;
  std::optional<Point> from_point(const Point& point, std::span<const double> u) const override;
  void functions_at(const Point& point, std::span<double> values) const override;

 private:
  raycast::Ray ray_from(const Point& point, std::span<const double> u) const;

  const raycast::RayCaster& rays_;
  ElementLocator locate_;
  LinesThrough lines_;
  struct Sender {
    UniformMap map;
    core::Frame frame;
  };
  std::vector<Sender> senders_;
  int functions_;
  std::vector<double> areas_;
  std::vector<PlaneBasis> bases_;  ///< of elements, unless of constants
};

}  // namespace interflect::fem

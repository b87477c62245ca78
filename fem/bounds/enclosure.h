#pragma once

#include <memory>
#include <span>

#include "core/interval.h"
#include "core/run.h"
#include "fem/radiosity.h"
#include "measure/measurement.h"

namespace interflect::fem {

/// Two-sided bounds of the exact solution, point by point, that are proved and not estimated: of B = E + rho T B about
/// what a solution has on its elements, however good or bad that is: its constants, or the linear parts B_h of its
/// polynomials.
///
///   e = B - B_h,   e = r + rho T e,   r = E + rho T B_h - B_h,   T >= 0
///
/// If e <= u everywhere, then T e <= T u: starting from u = max r / (1 - max rho), which is a bound, every iteration of
///
///   g <- min(g, (T (r + rho g))^+)
///
/// with an upper bound over each element is a bound of T e, and a better one; likewise from below (the monotone
/// iteration of an M-matrix).
///
/// T B_h over a part of an element is bounded by cell_transport.h, as a polynomial of second degree and its doubt; so r
/// is on the elements' quarters and theirs (node_residuals.h), and T (r + rho g) is by its means there, since the means
/// of a residual are small, as Galerkin's are, or cancel among quarters (error_transport.h).
///
/// Widths of e are O(h) about constants where the solution is smooth, since B varies by as much over an element, and
/// O(h²) about linear functions; those of H anywhere in an element are O(h) in any case.
/// They hold past whatever hides; what may be hidden in part is cut into smaller parts, and counts as anything from
/// nothing to all of it.  Rounding alone is not proved: 1e-11 of the largest |B_h|, and 1e-6 of the largest |r| and the
/// largest |T e| together, are added for it.  A scene counts as closed only where that is proved (lit_regions.h), but
/// for openings narrower than 1e-8 of its size.
/// Test: tests/fem/bounds/enclosure.cpp
class Enclosure {
 public:
  /// The scene and the solution outlive this.
  /// @throws core::InputError  a place that is there twice; where a surface reflects everything; where it takes more
  ///                           than `max_memory` [bytes]
  /// @throws core::Interrupted
  Enclosure(const scene::Scene& scene, const RadiositySolution& solution, double max_memory, Run& run);
  ~Enclosure();
  Enclosure(Enclosure&&) noexcept;

  /// Of irradiance H anywhere in an element, of its mean, and of radiosity E + rho H [W/m² | lx].
  std::span<const Interval> irradiance() const;
  std::span<const Interval> mean_irradiance() const;
  std::span<const Interval> radiosity() const;
  /// Of B - B_h anywhere in an element.
  std::span<const Interval> error() const;
  /// Of H at a point: T B_h to rounding (point_view_factors.h), and T e.  From any thread.
  Interval irradiance_at(const measure::PointIrradiance& at) const;

 private:
  class Iteration;
  std::unique_ptr<Iteration> of_;
};

}  // namespace interflect::fem

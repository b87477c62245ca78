#pragma once

#include "core/control_variate.h"
#include "measure/surface_solution.h"
#include "montecarlo/path_estimator.h"

namespace interflect::montecarlo {

/// Paths with a radiosity solution for what they leave out, the ambient term of [Lafortune, Willems 1994], as a control
/// variate: the answer has nothing of the solution's error.
///
/// A path that comes with the throughput T to a surface y of which the solution says that it reflects the radiance
/// h(y) goes on, S = 1, with the probability q, and scores
///
///   f' = f - c g,    f = .. + S / q T L(y),    g = sum over y of T h(y) (S / q - 1),    E g = 0 for any h:
///
/// with c = 1 it has h where it ends, instead of nothing, and where it goes on the difference L - h alone.  That is
/// multilevel Monte Carlo [Giles 2008] with a level for each bounce, whose samples are as many as survive.  q is
///
///   0.7 max(T rho, T h(y) / F),    F what is expected of the measurement (or T rho where nothing is),
///
/// since the noise of what y sends is in proportion to what it sends [Vorba, Krivanek 2016].  No weight exceeds
/// 1 / 0.7.  Where the solution knows nothing, h = 0, paths are those of PathEstimator.  So it is where not all is
/// diffuse, or T rho = 0, whatever the solution says: with q = 0, E g would be -T h.
class ControlledPaths {
 public:
  /// All must outlive it.
  ControlledPaths(const scene::Scene& scene, const raycast::RayCaster& caster, const measure::SurfaceSolution& solution,
                  const measure::PathClasses& paths);

  /// Of one path, in the unit of what was asked for.
  struct Found {
    Spectrum path;     ///< f, an unbiased estimate by itself
    Spectrum control;  ///< g, whose mean is 0
    Spectrum by(double c) const { return path - c * control; }
  };

  /// Irradiances at places [W/m² | lx], of paths that are traced together, each as it would be alone.
  /// @param expected  F, weighed, about; 0: unknown
  /// @param found     overwritten; as many as places
  void irradiance(std::span<const Receiver> at, const PathEstimator::Keys& keys, std::uint32_t block, double expected,
                  std::span<Found> found) const;
  /// Radiances that come along rays [W/(m² sr) | cd/m²]; F is what the solution says where a ray first ends.
  /// @param from_eye  none: a path that finds nothing
  void radiance(std::span<const std::optional<raycast::Ray>> from_eye, const PathEstimator::Keys& keys,
                std::uint32_t block, std::span<Found> found) const;

  const PathEstimator& paths() const { return paths_; }
  /// As PathEstimator::largest_score, by the largest weight of a path.
  Spectrum largest_score() const { return paths_.largest_score() / share_that_goes_on; }

 private:
  class Control;
  using Wave = PathEstimator::Wave<Control>;
  /// Less of it leaves more to the solution, more of it costs more rays than it is worth (docs/controlled.md).
  static constexpr double share_that_goes_on = .7;

  const measure::SurfaceSolution& solution_;
  PathEstimator paths_;
};

/// c by a pilot of f and g, between 0 and 1.5: 1 is right for a right solution, 1.5 for one that is a third too dark.  The
/// few paths of a pilot that missed g's rare large values, or met one, may say any number, whose noise nothing bounds.
double control_factor(const core::ControlVariate& pilot);

}  // namespace interflect::montecarlo

#pragma once

#include <span>
#include <vector>

#include "core/run.h"
#include "fem/form_factor/blockers.h"
#include "fem/form_factor/element_clusters.h"
#include "fem/space/plane_basis.h"
#include "measure/measurement.h"

namespace interflect::fem {

/// View factors of a point: what an element sends to it, with what hides parts of it taken out exactly,
///
///   F_{dA->j} = 1/pi int_{seen part of j} cos cos / r² dA,      H = sum_j F_{dA->j} B_j    (pi is inside, the
///   reflectance in B)
///
/// Lambert's formula on the part of j above the horizon of (x, n), less the same on what blockers hide of it, as
/// polygons ([Nishita, Nakamae 1985]; hidden_exchange.h).  In a closed scene the sum over j is 1.
///
/// Errors are bounds on rounding, since nothing else is approximate.  With delta = 4 eps (largest coordinate) for what
/// corners and the point are off, an edge e at the distance d shifts by delta / d where it is seen, over an arc of at
/// most min(pi, |e| / d); so it adds
///
///   1/pi min(pi, |e| / d) (min(1, delta / d) + 8 eps)                                    [to the error of F]
///
/// for each edge of j, and for each edge of a blocker that may hide a part of j, whose arc across j is not longer than
/// half of j's outline; where a blocker goes through j, delta is divided by the sine of the angle between their planes.
/// A point in the plane of a polygon, within rounding, does not see its side and is not hidden by it; the other answer
/// counts as error.
///
/// With polynomials on elements there is a number for each function, of a radiosity that is N_b, in closed form too
/// (polynomial_emitter.h): sum_b F_{dA->b} c_b is the irradiance of what is computed, and E + rho times that the
/// iterated solution [Sloan 1976]. Errors of an element's functions are those of constants times what functions are at
/// most.
/// Test: tests/fem/point_view_factors.cpp, tests/fem/space/rooms.cpp
class PointViewFactors {
 public:
  /// The patches outlive this.
  /// @param order     of polynomials on the elements, 0 .. 3
  /// @param accuracy  of what functions beyond constants send from afar, relative (distant_emitter.h); 0: to rounding
  PointViewFactors(const scene::Scene& scene, std::span<const scene::SurfacePatch> patches, int order = 0,
                   double accuracy = 0);

  Index elements() const { return static_cast<Index>(patches_.size()); }
  Index functions() const { return plane_functions(order_); }  ///< of an element
  /// @param F      one per element and function; of the first function in [0, 1]
  /// @param error  one per element; may exceed F
  void operator()(const measure::PointIrradiance& at, std::span<double> F, std::span<double> error) const;

 private:
  class Receiver;

  std::span<const scene::SurfacePatch> patches_;
  ElementShapes shapes_;
  std::vector<ElementCluster> clusters_;
  Blockers blockers_;
  int order_;
  double accuracy_;
  std::vector<PlaneBasis> bases_;  ///< none of constants
  double delta_ = 0;               ///< what a position relative to another may be off [m]
};

/// Where rows of points go.
class PointStore {
 public:
  virtual ~PointStore() = default;
  virtual bool is_done(Index point) const = 0;  ///< by an earlier run
  /// From any thread.
  virtual void write(Index point, std::span<const double> F, std::span<const double> error) = 0;
};

/// The rows that are not done, in parallel.  @throws core::Interrupted  with whole rows written
void assemble_points(const PointViewFactors& factors, std::span<const measure::PointIrradiance> points,
                     PointStore& store, Run& run);

}  // namespace interflect::fem

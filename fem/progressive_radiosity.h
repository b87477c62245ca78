#pragma once

#include <functional>
#include <limits>
#include <memory>

#include "fem/element_materials.h"
#include "fem/operator/rows_on_demand.h"
#include "fem/radiosity.h"

namespace interflect::fem {

/// Radiosity as far as it was shot.
struct Shots {
  solvers::SolverState state;        ///< x was shot, `residual` is unshot, in `step` shots
  solvers::ColumnMatrix irradiance;  ///< G^-1 K x, of what was shot: elements x channels
  solvers::ColumnMatrix variance;    ///< of that, from sampled visibility
  solvers::ColumnMatrix bound;       ///< on its errors that were not sampled

  Index count() const { return state.step; }
};

/// Progressive refinement of a scene without a matrix (solvers/progressive.h, or southwell.h): an element shoots by
/// what it sends to all others, which is computed for that shot alone (operator/rows_on_demand.h).  What there is may
/// be looked at after every shot, and gone on from, to the same bits.
/// Test: tests/fem/progressive_radiosity.cpp
class ProgressiveRadiosity {
 public:
  /// Scene, settings and run outlive this.  Of settings: constants on elements, a method that can be asked for one
  /// element's form factors, and as solver `progressive` or `southwell`; `max_memory` counts what elements carry.
  /// @throws core::InputError  otherwise
  ProgressiveRadiosity(const scene::Scene& scene, const RadiositySettings& settings, Run& run);

  const mesh::ElementMesh& mesh() const { return mesh_; }
  const solvers::System& system() const { return system_; }
  Index emitting() const;  ///< elements that emit

  Shots begin() const;  ///< nothing is shot yet
  /// Goes on until the settings' StoppingRule is met: `unshot`, and `tolerance` on the residual; or until the run is
  /// asked to stop.
  /// @param look  at what there is, after every shot
  /// @param most  shots in all, those of earlier calls included, after which it stops in any case
  /// @throws core::InputError  where a row adds up to more than it can (row_sum_check.h)
  solvers::SolverReport advance(Shots& shots, const std::function<void(const Shots&)>& look,
                                int most = std::numeric_limits<int>::max());
  /// sum A |r| / sum A |e|, the largest of the channels.
  double unshot_fraction(const Shots& shots) const;

  /// What is shown: B = x + r + rho Amb and H = G^-1 K x + Amb, with the ambient term of all that is unshot.
  ///
  /// Its error is an estimate, the sum of |Amb|, which only stands for light that is still on its way; of the bounds of
  /// form factors, over 1 - mean rho; and, since no matrix tells what halving the elements would change, of what
  /// irradiance varies by inside the element, and radiosity in the mean of all elements, over 1 - mean rho.
  /// Its noise is that of the form factors, and at most sqrt(2) rho / (1 - rho) times that of the mean in all elements
  /// alike, as if no two shared a pair (error_estimate.h).
  RadiositySolution shown(const Shots& shots, const solvers::SolverReport& report) const;
  /// |Amb|, as it is in the errors of `shown` [W/m² | lx].
  Spectrum missing(const Shots& shots) const;

 private:
  void take(Shots& shots, solvers::ColumnMatrix& shot_before) const;

  const scene::Scene& scene_;
  const RadiositySettings& settings_;
  Run& run_;
  mesh::ElementMesh mesh_;
  double element_size_;
  ElementMaterials materials_;
  solvers::ColumnMatrix e_;
  solvers::Reflection R_;
  std::unique_ptr<raycast::RayCaster> rays_;
  std::unique_ptr<FormFactorMethod> method_;
  RowsOnDemand K_;
  solvers::System system_;
};

}  // namespace interflect::fem

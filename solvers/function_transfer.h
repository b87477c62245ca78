#pragma once

#include "solvers/power_draw.h"
#include "solvers/sampled_bounce.h"
#include "solvers/solver.h"
#include "solvers/transition_sampler.h"

namespace interflect::solvers {

/// A bounce of polynomials by rays [Bekaert 1999, approximations of higher order]: of N rays each leaves an element j,
/// drawn by the probability p_j in proportion to A_j times the root mean square of B_j, at a uniform point y, and
/// brings
///
///   rho_i N_a(x) A_j B_j(y) / (p_j N)        to every function a of the element i where it arrives, at x
///
/// Its mean is rho_i sum_b K_ab B_b = G_a times what one bounce of B has for a coefficient.  Of constants it is
/// PowerTransfer.
///
/// What few rays say of f functions is mostly noise, sqrt(f) times as large as what they bring, and would be sent on:
/// of E elements m f E rays are asked for, m = 4 + 2 rho² / (1 - rho²), so that rho sqrt(1 + 1 / m) < 1.
class FunctionTransfer final : public SampledBounce {
 public:
  /// All outlive this.  Walks have points with the functions of K (require_walks).
  FunctionTransfer(const System& system, const ColumnMatrix& power);
  void add(const core::SampleSequence& sequence, std::uint64_t first, std::uint64_t count, double weight,
           ColumnMatrix& reflected) const override;
  Eigen::RowVectorXd sizes() const override { return draw_.sizes(); }
  std::uint64_t least_samples() const override;

 private:
  const System& system_;
  const PointTransitions& points_;
  ColumnMatrix coefficients_;
  PowerDraw draw_;
};

}  // namespace interflect::solvers

#pragma once

#include "solvers/sampled_bounce.h"
#include "solvers/solver.h"

namespace interflect::solvers {

/// Jacobi's iteration with bounces by samples (sampled_bounce.h): incremental, what a bounce brought being what the
/// next one sends, with samples in proportion to it; each estimate is unbiased.  Then, with twice as many each
/// time, anew, and all are averaged by their samples; all but `incremental` and
/// `importance_driven` let a bounce of all that the last solution had take the
/// place of every new one, which costs less.
///
///   incremental, regular   rays that carry light one way (power_transfer.h); of polynomials function_transfer.h
///   bidirectional          both ways, which needs a symmetric K
///   control_variate        one way, of what differs from a constant (constant_control_variate.h), in closed rooms
///   global_lines           lines through everything (line_transfer.h)
///   importance_driven      incremental, rays being drawn in proportion to power times what that is worth to the
///                          target, w of a bounce in potential.h [Neumann et al. 1996; Bekaert 1999]
///
/// Errors are by independent replications.
/// Test: tests/solvers/stochastic_jacobi.cpp
class StochasticJacobi final : public RadiositySolver {
 public:
  enum class Kind { incremental, regular, bidirectional, control_variate, global_lines, importance_driven };
  StochasticJacobi(Kind kind, const SolverSettings& settings) : kind_(kind), settings_(settings) {}
  std::string name() const override;
  SolverReport advance(const System& system, SolverState& state, const StoppingRule& rule, Run& run) const override;

 private:
  /// How bounces are sampled.  @param worth  of what is sent to the target, which may change from round to round
  /// @throws core::InputError  where the system has not what that needs
  BounceFactory bounces_of(const System& system, const ColumnMatrix& worth, const Run& run) const;

  Kind kind_;
  SolverSettings settings_;
};

}  // namespace interflect::solvers

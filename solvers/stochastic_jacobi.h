#pragma once

#include "core/sample_sequence.h"
#include "solvers/power_draw.h"
#include "solvers/solver.h"
#include "solvers/transition_sampler.h"

namespace interflect::solvers {

/// Jacobi's iteration on powers, each product by rays [Neumann et al. 1994, 1995; Bekaert 1999]: of N rays each leaves an
/// unknown j drawn in proportion to its power P_j, and brings
///
///   rho_i P_j / (p_j N)        to the i where it arrives, p_j the probability of j       (rho_i P / N of one column)
///
/// Its mean is rho_i sum_j F_ji P_j, the power that one bounce of P reflects at i; of one column its variance, as radiosity, is
/// V = (rho_i P / G_i b_i - b_i²) / N.
class PowerTransfer {
 public:
  PowerTransfer(const System& system, const ColumnMatrix& power);

  /// By rays first .. first + count of a sequence; brings are added, times `weight`.
  void add(const core::SampleSequence& sequence, std::uint64_t first, std::uint64_t count, double weight,
           ColumnMatrix& reflected) const;

 private:
  const System& system_;
  const ColumnMatrix& power_;
  PowerDraw draw_;
};

/// The whole solution: incremental, what a bounce brought being what the next one sends, with rays in proportion to it,
/// until 1e-7 of the power is left; each estimate is unbiased but for that.  Then, with twice the rays each time, anew,
/// and all are averaged by their rays; with `regular`, a bounce of all of the average that there is takes the place of
/// every new solution, which costs less.  Errors are by independent replications.
/// Test: tests/solvers/stochastic_jacobi.cpp
class StochasticJacobi final : public RadiositySolver {
 public:
  StochasticJacobi(bool regular, const SolverSettings& settings) : regular_(regular), settings_(settings) {}
  std::string name() const override { return regular_ ? "regular-stochastic-jacobi" : "stochastic-jacobi"; }
  SolverReport advance(const System& system, SolverState& state, const StoppingRule& rule, Run& run) const override;

 private:
  bool regular_;
  SolverSettings settings_;
};

}  // namespace interflect::solvers

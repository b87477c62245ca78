#pragma once

#include "solvers/solver.h"

namespace interflect::solvers {

/// Jacobi's iteration with bounces by rays (power_transfer.h): incremental, what a bounce brought being what the next one sends, with rays in proportion to it,
/// until 1e-7 of the power is left; each estimate is unbiased but for that.  Then, with twice the rays each time, anew,
/// and all are averaged by their rays; with `regular`, a bounce of all of the average that there is takes the place of
/// every new solution, which costs less; with `bidirectional`, moreover, lines carry light both ways, which needs a symmetric K.
/// Errors are by independent replications.
/// Test: tests/solvers/stochastic_jacobi.cpp
class StochasticJacobi final : public RadiositySolver {
 public:
  enum class Kind { incremental, regular, bidirectional };
  StochasticJacobi(Kind kind, const SolverSettings& settings) : kind_(kind), settings_(settings) {}
  std::string name() const override;
  SolverReport advance(const System& system, SolverState& state, const StoppingRule& rule, Run& run) const override;

 private:
  Kind kind_;
  SolverSettings settings_;
};

}  // namespace interflect::solvers

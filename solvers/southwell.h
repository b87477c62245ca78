#pragma once

#include "solvers/solver.h"

namespace interflect::solvers {

/// The unknown with the largest |G_i r_i| first, so that its equation holds, step after step [Southwell 1946; for
/// radiosity Gortler, Cohen, Slusallek 1994]; shooting.h has the step.  As many steps as there are unknowns are about a
/// sweep's work.  Needs rows of a symmetric K; the residual is known after every step.
/// Test: tests/solvers/shooting.cpp
class Southwell final : public RadiositySolver {
 public:
  /// @param steps  that are an iteration; 0: as many as there are unknowns
  explicit Southwell(Index steps = 0) : steps_(steps) {}
  std::string name() const override { return "southwell"; }
  SolverReport advance(const System& system, SolverState& state, const StoppingRule& rule, Run& run) const override;

 private:
  Index steps_;
};

}  // namespace interflect::solvers

#pragma once

#include "solvers/solver.h"

namespace interflect::solvers {

/// The one that suits the operator: conjugate gradients where K is symmetric, else generalised minimal residuals.
class Automatic final : public RadiositySolver {
 public:
  std::string name() const override { return "automatic"; }
  SolverReport advance(const System& system, SolverState& state, const StoppingRule& rule, Run& run) const override;
};

}  // namespace interflect::solvers

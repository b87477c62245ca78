#pragma once

#include "solvers/solver.h"

namespace interflect::solvers {

/// Every bounce at once: b <- e + R G^-1 K b [Jacobi's method on I - R G^-1 K with the diagonal left in K].
///
/// Needs `apply` alone.  One iteration is one light bounce, so the error falls at least by max(rho) x max(row sum of F)
/// each, in the largest |b| of a column.  Columns are independent; all stop together.
class Jacobi final : public RadiositySolver {
 public:
  std::string name() const override { return "jacobi"; }
  /// @throws core::InputError  where the system is not one (`require_solvable`)
  SolverReport advance(const System& system, SolverState& state, const StoppingRule& rule, Run& run) const override;
};

}  // namespace interflect::solvers

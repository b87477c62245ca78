#pragma once

#include "solvers/solver.h"

namespace interflect::solvers {

/// Generalised minimal residuals [Saad, Schultz 1986] on (I - R G^-1 K) b = e, which asks for nothing but `apply`: for
/// collocation, whose K is not symmetric.  Of every column the Euclidean norm of the residual is the least that there
/// is in the space of all that were bounced so far, orthonormalised by modified Gram-Schmidt's method, and never grows;
/// after `restart` of them it begins anew from what it has.  Columns share products: one an iteration, and one at every
/// start.
/// Test: tests/solvers/krylov.cpp
class Gmres final : public RadiositySolver {
 public:
  explicit Gmres(int restart = 40) : restart_(restart) {}
  std::string name() const override { return "gmres"; }
  /// @throws core::InputError  where the system is not one (`require_solvable`)
  SolverReport advance(const System& system, SolverState& state, const StoppingRule& rule, Run& run) const override;

 private:
  int restart_;
};

}  // namespace interflect::solvers

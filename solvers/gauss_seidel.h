#pragma once

#include "solvers/solver.h"

namespace interflect::solvers {

/// Row after row with the newest values: for a = 0, 1, ..
///
///   b_a (1 - rho_a K_aa / G_a) = e_a + rho_a / G_a sum_{b != a} K_ab b_b
///
/// About half as many sweeps as Jacobi's method needs (methods: 64 against 127 at rho = 0.9).  Needs `RowAccess`, and
/// fetches each row once a sweep, in blocks.  The residual of the new b costs no pass of its own where K is symmetric:
/// what is missing from row a is the change of the unknowns after it,
///
///   e + R G^-1 K b - b  at a  =  rho_a / G_a sum_{b > a} K_ab (b_b - b_b,before),
///
/// and K_ab = K_ba is at hand when row b is swept.  Else it is one `apply` a sweep.
/// Same bits for any number of threads: sums over a row run in one order, threads share the rows of a block.
class GaussSeidel final : public RadiositySolver {
 public:
  std::string name() const override { return "gauss-seidel"; }
  /// @throws core::InputError  where the operator has no rows, or the system is not one (`require_solvable`)
  SolverReport advance(const System& system, SolverState& state, const StoppingRule& rule, Run& run) const override;
};

}  // namespace interflect::solvers

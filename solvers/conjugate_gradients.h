#pragma once

#include "solvers/solver.h"

namespace interflect::solvers {

/// Conjugate gradients [Hestenes, Stiefel 1952] on the symmetrised system: with S = G^-1/2 K G^-1/2 and Q Q = R,
///
///   (I - Q S Q) t = Q S G^1/2 e,      b = e + G^-1/2 Q t
///
/// which never divides by a reflectance, so that rho = 0 needs no care, and R may be blocks.  Where row sums are at
/// most 1 its eigenvalues lie in [1 - rho, 1 + rho] with the largest reflectance rho: it is positive definite, and the
/// error falls by (sqrt(k) - 1) / (sqrt(k) + 1), k = (1 + rho) / (1 - rho), an iteration at least; far faster where few
/// eigenvalues are large, as in rooms: 13 iterations where Jacobi's needs 1 373 (rho = .99, cube).
///
/// The residual e + R G^-1 K b - b is G^-1/2 Q times that of t.  Columns have their own coefficients and share
/// products: one an iteration, and one to begin with.  Needs `apply` alone, and a symmetric K.
/// Test: tests/solvers/krylov.cpp
class ConjugateGradients final : public RadiositySolver {
 public:
  std::string name() const override { return "conjugate-gradients"; }
  /// @throws core::InputError  where K is not symmetric, or the system is not one (`require_solvable`)
  SolverReport advance(const System& system, SolverState& state, const StoppingRule& rule, Run& run) const override;
};

}  // namespace interflect::solvers

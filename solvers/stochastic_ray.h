#pragma once

#include "solvers/solver.h"

namespace interflect::solvers {

/// The stochastic ray method [Neumann et al. 1995]: a few rays at a time, each time of all that there is,
/// and the solution goes part of the way to what they say,
///
///   x <- (1 - tau) x + tau (e + R G^-1 K x, by m rays),     tau = c m / (rays so far + c m),  c = 1 / (1 - mean rho)
///
/// which is stochastic approximation [Robbins, Monro 1951]: c makes errors, that decay as rays^-(c (1 - rho)), fade as
/// fast as noise does. It begins with an unbiased x (sampled_bounce.h, incremental), and stays so, since its steps are
/// linear in x.  Rays are not of equal power: they are drawn half in proportion to power and half to area, so that dim
/// unknowns are heard as well.
/// Test: tests/solvers/stochastic_jacobi.cpp
class StochasticRay final : public RadiositySolver {
 public:
  explicit StochasticRay(const SolverSettings& settings) : settings_(settings) {}
  std::string name() const override { return "stochastic-ray"; }
  SolverReport advance(const System& system, SolverState& state, const StoppingRule& rule, Run& run) const override;

 private:
  SolverSettings settings_;
};

}  // namespace interflect::solvers

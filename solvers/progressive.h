#pragma once

#include "solvers/solver.h"

namespace interflect::solvers {

/// Progressive refinement [Cohen, Chen, Wallace, Greenberg 1988]: the unknown with the most unshot light shoots all of
/// it, by one row of K that may be computed on demand; shooting.h has the step.  x is what was shot, and unshot light r
/// its residual, so that shot and unshot light together, x + r, is one bounce better than x; what a viewer is shown is
///
///   x + r + rho Amb
///
/// with the ambient term of shooting.h.  With overshooting [Feda, Purgathofer 1992] an unknown shoots a share of it
/// ahead, and keeps as much unshot with the other sign: it helps at middle reflectances and hurts at high ones.
///
/// An iteration is `steps` of them, after which the observer may look.  Ends, too, at a fraction of unshot light.
/// Test: tests/solvers/shooting.cpp
class Progressive final : public RadiositySolver {
 public:
  explicit Progressive(const SolverSettings& settings = {}) : settings_(settings) {}
  std::string name() const override { return "progressive"; }
  SolverReport advance(const System& system, SolverState& state, const StoppingRule& rule, Run& run) const override;

 private:
  SolverSettings settings_;
};

/// What there is to be seen of a state: x, with what is unshot and its ambient term where the solver keeps it.
ColumnMatrix for_display(const System& system, const SolverState& state);

}  // namespace interflect::solvers

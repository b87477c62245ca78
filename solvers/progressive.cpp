#include "solvers/progressive.h"

#include "solvers/shooting.h"

namespace interflect::solvers {

ColumnMatrix for_display(const System& system, const SolverState& state) {
  if (state.residual.size() == 0) return state.x;
  const Eigen::RowVectorXd amb = ambient(system, state.residual);
  return state.x + state.residual + ColumnMatrix(system.R.reflectance() * amb.asDiagonal());
}

SolverReport Progressive::advance(const System& system, SolverState& state, const StoppingRule& rule, Run& run) const {
  return solve_by_steps(
      system, name(), state, rule, run, settings_.overshoot, settings_.steps,
      [](Shooting& shooting, Index brightest) { shooting.step(brightest, shooting.to_shoot(brightest)); });
}

}  // namespace interflect::solvers

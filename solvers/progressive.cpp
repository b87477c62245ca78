#include "solvers/progressive.h"

#include "solvers/iterations.h"
#include "solvers/shooting.h"
#include "solvers/system_check.h"

namespace interflect::solvers {
ColumnMatrix for_display(const System& system, const SolverState& state) {
  if (state.residual.size() == 0) return state.x;
  const Eigen::RowVectorXd amb = ambient(system, state.residual);
  return state.x + state.residual + ColumnMatrix(system.R.reflectance() * amb.asDiagonal());
}

SolverReport Progressive::advance(const System& system, SolverState& state, const StoppingRule& rule, Run& run) const {
  require_solvable(system);
  if (!prepare(system, state)) return {.why = SolverReport::Stopped::nothing_to_do};
  Shooting shooting = begin_shooting(system, name(), state, run, settings_.overshoot);
  const Index of_iteration = settings_.steps > 0 ? settings_.steps : shooting.unknowns();
  Iterations iterations(state, rule, run);
  for (bool more = true; more;) {
    Index steps = 0;
    while (steps < of_iteration && !is_enough(shooting, rule) && (steps == 0 || !iterations.interrupted())) {
      const Index i = shooting.brightest();
      shooting.step(i, shooting.to_shoot(i));
      ++steps;
    }
    ColumnMatrix x = shooting.x(), r = shooting.residual();
    more = iterations.next(x, r, {shooting.relative_residual(), static_cast<double>(steps), is_enough(shooting, rule)});
  }
  return iterations.report();
}

}  // namespace interflect::solvers

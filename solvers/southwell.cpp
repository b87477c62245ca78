#include "solvers/southwell.h"

#include "solvers/iterations.h"
#include "solvers/shooting.h"
#include "solvers/system_check.h"

namespace interflect::solvers {

SolverReport Southwell::advance(const System& system, SolverState& state, const StoppingRule& rule, Run& run) const {
  require_solvable(system);
  if (!prepare(system, state)) return {.why = SolverReport::Stopped::nothing_to_do};
  Shooting shooting = begin_shooting(system, name(), state, run);
  const Index of_iteration = steps_ > 0 ? steps_ : shooting.unknowns();
  Iterations iterations(state, rule, run);
  for (bool more = true; more;) {
    Index steps = 0;
    while (steps < of_iteration && !is_enough(shooting, rule) && (steps == 0 || !iterations.interrupted())) {
      shooting.relax(shooting.brightest());
      ++steps;
    }
    ColumnMatrix x = shooting.x(), r = shooting.residual();
    more = iterations.next(x, r, {shooting.relative_residual(), static_cast<double>(steps), is_enough(shooting, rule)});
  }
  return iterations.report();
}

}  // namespace interflect::solvers

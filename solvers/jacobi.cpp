#include "solvers/jacobi.h"

#include "solvers/bounce.h"
#include "solvers/iterations.h"
#include "solvers/system_check.h"

namespace interflect::solvers {

SolverReport Jacobi::advance(const System& system, SolverState& state, const StoppingRule& rule, Run& run) const {
  require_solvable(system);
  if (!prepare(system, state)) return {.why = SolverReport::Stopped::nothing_to_do};
  Iterations iterations(state, rule, run);
  for (;;) {
    // The residual belongs to x, not to `next`: the last x that has one is the result.
    ColumnMatrix next = bounced(system, state.x, run);
    if (!iterations.next({relative_size(next - state.x, state.x), static_cast<double>(state.x.rows())}))
      return iterations.report();
    state.x.swap(next);
  }
}

}  // namespace interflect::solvers

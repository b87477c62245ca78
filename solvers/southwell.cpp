#include "solvers/southwell.h"

#include "solvers/shooting.h"

namespace interflect::solvers {

SolverReport Southwell::advance(const System& system, SolverState& state, const StoppingRule& rule, Run& run) const {
  return solve_by_steps(system, name(), state, rule, run, 0, steps_,
                        [](Shooting& shooting, Index brightest) { shooting.relax(brightest); });
}

}  // namespace interflect::solvers

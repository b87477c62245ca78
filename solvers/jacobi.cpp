#include "solvers/jacobi.h"

#include "solvers/system_check.h"

namespace interflect::solvers {

SolverReport Jacobi::advance(const System& system, SolverState& state, const StoppingRule& rule, Run& run) const {
  require_solvable(system);
  if (!prepare(system, state)) return {.why = SolverReport::Stopped::nothing_to_do};
  const Eigen::Map<const Eigen::VectorXd> G(system.K.gram().data(), state.x.rows());
  ColumnMatrix h(state.x.rows(), state.x.cols()), next;
  SolverReport report;
  for (;;) {
    system.K.apply(state.x, h, run);
    h.array().colwise() /= G.array();
    next = system.e;
    system.R.add_reflected(h, next);
    // The residual belongs to x, not to `next`: the last x that has one is the result.
    const bool more = go_on(report, relative_size(next - state.x, state.x), rule, run);
    ++state.step;
    if (!more) return report;
    state.x.swap(next);
  }
}

}  // namespace interflect::solvers

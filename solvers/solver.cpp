#include "solvers/solver.h"

namespace interflect::solvers {

std::string describe(SolverReport::Stopped why) {
  switch (why) {
    case SolverReport::Stopped::converged:
      return "converged";
    case SolverReport::Stopped::iteration_limit:
      return "iteration limit reached";
    case SolverReport::Stopped::time_limit:
      return "out of time";
    case SolverReport::Stopped::asked_to:
      return "asked to stop";
    case SolverReport::Stopped::nothing_to_do:
      return "nothing emits";
  }
  return "unknown";
}

std::vector<double> SolverReport::residuals() const {
  std::vector<double> all;
  for (const IterationRecord& iteration : history) all.push_back(iteration.residual);
  return all;
}

}  // namespace interflect::solvers

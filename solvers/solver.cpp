#include "solvers/solver.h"

#include "core/error.h"
#include "solvers/gauss_seidel.h"
#include "solvers/jacobi.h"

namespace interflect::solvers {

std::string describe(SolverReport::Stopped why) {
  switch (why) {
    case SolverReport::Stopped::converged:
      return "converged";
    case SolverReport::Stopped::iteration_limit:
      return "iteration limit reached";
    case SolverReport::Stopped::asked_to:
      return "asked to stop";
    case SolverReport::Stopped::nothing_to_do:
      return "nothing emits";
  }
  return "unknown";
}

std::unique_ptr<RadiositySolver> make_solver(const std::string& name) {
  if (name == "gauss-seidel") return std::make_unique<GaussSeidel>();
  if (name == "jacobi") return std::make_unique<Jacobi>();
  std::string known;
  for (const std::string& each : solver_names()) known += (known.empty() ? "" : ", ") + each;
  throw core::InputError("solver '" + name + "'", "one of " + known + " expected");
}

std::vector<std::string> solver_names() { return {"gauss-seidel", "jacobi"}; }

}  // namespace interflect::solvers

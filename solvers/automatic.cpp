#include "solvers/automatic.h"

#include "solvers/conjugate_gradients.h"
#include "solvers/gmres.h"

namespace interflect::solvers {

SolverReport Automatic::advance(const System& system, SolverState& state, const StoppingRule& rule, Run& run) const {
  if (system.K.symmetric()) return ConjugateGradients().advance(system, state, rule, run);
  return Gmres().advance(system, state, rule, run);
}

}  // namespace interflect::solvers

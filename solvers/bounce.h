#pragma once

#include "solvers/solver.h"

namespace interflect::solvers {

/// e + R G^-1 K x: what is emitted, and one bounce of what leaves.  One product.
ColumnMatrix bounced(const System& system, ConstColumns x, Run& run);

/// e + R G^-1 K x - x
inline ColumnMatrix residual_of(const System& system, ConstColumns x, Run& run) { return bounced(system, x, run) - x; }

}  // namespace interflect::solvers

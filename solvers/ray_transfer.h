#pragma once

#include "solvers/function_transfer.h"
#include "solvers/power_transfer.h"

namespace interflect::solvers {

/// Bounces by rays one way: of constants, or of polynomials where elements have several functions.  The system, whose
/// walks have what that needs (require_walks), outlives it.
inline BounceFactory ray_transfer(const System& system) {
  if (system.K.layout().constants())
    return [&system](const ColumnMatrix& power) { return std::make_unique<PowerTransfer>(system, power); };
  return [&system](const ColumnMatrix& power) { return std::make_unique<FunctionTransfer>(system, power); };
}

}  // namespace interflect::solvers

#pragma once

#include "fem/operator/node_operator.h"
#include "fem/operator/symmetric_operator.h"
#include "fem/space/node_set.h"

namespace interflect::fem {

/// Galerkin's method for continuous functions around the operator of discontinuous ones: with values v at corners,
/// c = P v, and what K and G are to coefficients c,
///
///   M v = P^T G e + rho P^T K P v,    M = P^T G P  (sparse),     T = M^-1 P^T K P
///
/// where rho is one number over all that is continuous: a side of a surface.
/// @param K      of the space's unknowns
/// @param nodes  corner_nodes of the space
/// Test: tests/fem/space/node_methods.cpp
NodeOperator continuous_galerkin(const SymmetricOperator& K, const NodeSet& nodes, Run& run);

}  // namespace interflect::fem

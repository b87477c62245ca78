#pragma once

#include "fem/kernel.h"
#include "fem/operator/node_operator.h"
#include "fem/point_view_factors.h"
#include "fem/space/node_set.h"

/// Point collocation: the equation holds at nodes, and unknowns are the values there,
///
///   b_a = e_a + rho_a sum_b T_ab b_b,    T_ab = sum_i P_ib int k(x_a, y) N_i(y) dy
///
/// with the field P b that values at nodes stand for (space/node_set.h).  G is the identity; T is not symmetric.
/// Test: tests/fem/space/strips.cpp, tests/fem/space/node_methods.cpp
namespace interflect::fem {

/// Of any kernel, past nothing that hides.
/// @param points  of the inner integrals, by Gauss rules
NodeOperator collocation(const Space& space, const NodeSet& nodes, const Kernel& kernel, int points, Run& run);

/// Of elements of a scene, past whatever hides: inner integrals in closed form.
/// @param factors  of the functions of the space, on its panels: the patches
NodeOperator collocation(const NodeSet& nodes, const PointViewFactors& factors,
                         std::span<const scene::SurfacePatch> patches, Run& run);

}  // namespace interflect::fem

#pragma once

#include "fem/form_factor/method.h"
#include "fem/kernel.h"
#include "fem/pair_rule.h"

namespace interflect::fem {

/// The block K_ab of panels i and j, as below.  What one hides from the other, or a third from both, is the kernel's.
Eigen::MatrixXd galerkin_block(const Space& space, Index i, Index j, const Kernel& kernel, const PairRule& rule);

/// Galerkin's method: every pair of unknowns of two panels, of kernel, rule and space as they come,
///
///   K_ab = int int N_a(x) k(x, y) N_b(y) dy dx,    h = G^-1 K b
///
/// @param sink  gets unknowns, a < b, of panels i < j; a panel sees nothing of itself
void galerkin(const Space& space, const Kernel& kernel, const PairRule& rule, ExchangeSink& sink, Run& run);

}  // namespace interflect::fem

#pragma once

#include <vector>

#include "fem/operator/dense_symmetric.h"
#include "fem/radiosity.h"

namespace interflect::fem {

/// What the irradiance of each element may owe to the variation of radiosity inside the elements next to it [W/m² | lx]:
///
///   error_i = sum over near j of F_ij rho_j sqrt(3) variation_j,      near: |c_i - c_j| < 1.5 (r_i + r_j)
///
/// Radiosity that varies inside a distant element averages out, since the kernel hardly varies over it: that part falls as h² and
/// halving the elements shows it.  Beside a common edge it does not: element i sees the near end of j only, and the constant is
/// wrong there by the deviation at j's edge, sqrt(3) of its root mean square for a linear field.  Halving changes little of it,
/// because the neighbour's end stays as near; so it is bounded by itself.
///
/// Needs `reflectance` and `irradiance` of the solution.
std::vector<Spectrum> neighbour_errors(const RadiositySolution& solution, const DenseSymmetric& K, const Run& run);

}  // namespace interflect::fem

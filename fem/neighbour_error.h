#pragma once

#include <vector>

#include "fem/operator/dense_symmetric.h"
#include "fem/radiosity.h"

namespace interflect::fem {

/// What the irradiance of each element owes to the variation of radiosity inside the elements next to it [W/m² | lx]:
///
///   error_i = (1 + sqrt 2) | sum over near j of F_ij rho_j g_j . (p_ij - c_j) |,      near: |c_i - c_j| < 1.5 (r_i + r_j)
///
/// g_j is the gradient of irradiance at j (least squares over its parent's four children), c_j the centroid of j, and p_ij its centroid
/// as i sees it: the mean of the centroids of its 16 parts, weighted by Lambert's formula from c_i.
///
/// Radiosity that varies inside a distant element averages out, since the kernel hardly varies over it: that part falls as h² and
/// halving the elements shows it.  Beside a common edge it does not: i sees the near end of j only, and halving changes little of
/// it, because the neighbour's end stays as near.  Nor is irradiance linear in a concave edge: with a + b r^p at distance r, the first
/// cell's mean deviates 2 / (2^(1+p) - 2) times as much from the value at the edge as the difference of the first two means tells of a
/// linear field; p = 1/2 is taken, which makes 1 + sqrt 2.
///
/// Needs `reflectance` and `irradiance` of the solution.
std::vector<Spectrum> neighbour_errors(const RadiositySolution& solution, const DenseSymmetric& K, const Run& run);

/// The irradiance at `x` in the plane of element `j`, less that of the element, by the linear field through its parent's four children.
Spectrum linear_deviation(const RadiositySolution& solution, std::size_t j, const Vec3& x);

}  // namespace interflect::fem

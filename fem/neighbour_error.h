#pragma once

#include <vector>

#include "fem/operator/symmetric_operator.h"
#include "fem/radiosity.h"

namespace interflect::fem {

/// What the irradiance of each element owes to the variation of radiosity inside the elements next to it [W/m² | lx]:
///
///   error_i = (1 + sqrt 2) | sum_j F_ij rho_j g_j . (p_ij - c_j) |  +  sum_j F_ij rho_j H_j max(0, 1 - 6 f_ij)
///
/// over the near j, |c_i - c_j| < 1.5 (r_i + r_j).  g_j is the gradient of irradiance at j (least squares over its
/// parent's four children), c_j the centroid of j, p_ij its centroid as i sees it and f_ij the fraction of it that i
/// sees: with the weights w that Lambert's formula gives the 16 parts of j from c_i,  p = sum w c / sum w,  f = (sum
/// w)² / (16 sum w²).
///
/// Radiosity that varies inside a distant element averages out, since the kernel hardly varies over it: that part falls
/// as h² and halving the elements shows it.  Beside a common edge it does not: i sees the near end of j only, and
/// halving changes little of it, because the neighbour's end stays as near.  Nor is irradiance linear in a concave
/// edge: with a + b r^p at distance r, the first cell's mean deviates 2 / (2^(1+p) - 2) times as much from the value at
/// the edge as the difference of the first two means tells of a linear field; p = 1/2 is taken, which makes 1 + sqrt 2.
///
/// A small element in a corner, a crevice or before a large wall sees but a spot of it (f below 1/6: one or two parts
/// of 16).  What constants say of such a spot is nothing: it may be dark, since radiosity is not negative, while the
/// rest has all.
///
/// Needs `reflectance` and `irradiance` of the solution.
std::vector<Spectrum> neighbour_errors(const RadiositySolution& solution, const SymmetricOperator& K, const Run& run);

/// The irradiance at `x` in the plane of element `j`, less that of the element, by the linear field through its
/// parent's four children.
Spectrum linear_deviation(const RadiositySolution& solution, std::size_t j, const Vec3& x);

}  // namespace interflect::fem

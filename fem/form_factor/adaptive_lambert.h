#pragma once

#include <span>

#include "core/vec.h"
#include "fem/form_factor/integral.h"

namespace interflect::fem {

/// How an adaptive integral is to be taken.
struct LambertEffort {
  double tolerance;               ///< of the error, relative
  std::size_t most_cells = 4000;  ///< 1: no cell is cut
};

/// K = int_{outer} F_{dA->inner} dA [m²]: Lambert's formula inside, Gauss rules outside, on cells of `outer` that are
/// cut in four (four_parts.h) where the integrand is rough: towards a corner or an edge of `inner` that touches or
/// nearly touches `outer`.
///
/// The worst cell is cut first, until the errors sum to at most `tolerance` times the value. A cell's error is taken
/// from the difference e between its rule and the sum of its parts', and from how much its parts differ for their
/// areas, d, because e may be small by chance (less so where many cells are summed: d counts 0.3 of it with each cut):
///
///   s = (radius of the cell) / (distance of its middle from inner's outline)
///   smooth, s < 0.8:  c e + f s^p d,    rough:  e + g d
///
/// Where the cell is smooth its quarters err by e / 64 with the rules of order 6, parts across by less; where inner's
/// outline touches it the factor is of degree 0 in the distance, and they err by e / 3. Constants were fitted to 12 000
/// random pairs; on 10 000 others the true error is below the estimate in 99 %, and a fifth of it in the median. Below
/// a tolerance of 1e-7 the rules are of order 9 and 12.
///
/// @param outer, inner  planar convex rings, neither with a corner behind the other's plane; outer has `normal`
///          [unit]
/// @return  value >= 0 and an estimate of its error, rounding included; above the tolerance only if the cells were
///          not enough, or rounding is
///
/// Test: tests/fem/form_factors.cpp, by closed forms; tests/fem/stated_errors.cpp.
Integral adaptive_lambert(std::span<const Vec3> outer, const Vec3& normal, std::span<const Vec3> inner,
                          const LambertEffort& effort);
inline Integral adaptive_lambert(std::span<const Vec3> outer, const Vec3& normal, std::span<const Vec3> inner,
                                 double tolerance) {
  return adaptive_lambert(outer, normal, inner, LambertEffort{tolerance});
}

/// What the error of adaptive_lambert is, relative, where no cell is cut: an order of magnitude, from s alone.
double expected_lambert_error(std::span<const Vec3> outer, std::span<const Vec3> inner);

}  // namespace interflect::fem

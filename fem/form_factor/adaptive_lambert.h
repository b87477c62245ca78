#pragma once

#include <span>

#include "core/vec.h"

namespace interflect::fem {

/// An integral and what its error is estimated to be at most.
struct Integral {
  double value = 0, error = 0;
};

/// K = int_{outer} F_{dA->inner} dA [m²]: Lambert's formula inside, Gauss rules outside, on cells of `outer` that are halved
/// in both directions where the integrand is rough: towards a corner or an edge of `inner` that touches or nearly touches
/// `outer`.
///
/// A cell's error is the difference between its rule and the sum of its quarters'; the worst cell is cut first, until the
/// errors sum to at most `tolerance` times the value.  The factor is bounded and of degree 0 in the distance to such a
/// corner, so that the error falls by four with each level there and the cost grows with log(1 / tolerance).
/// @param outer, inner  planar convex rings, neither with a corner behind the other's plane; outer has `normal` [unit]
/// @return  value >= 0 and an estimated bound on its error; that bound exceeds the tolerance only if 4 000 cells were not enough
/// Test: tests/fem/form_factors.cpp, by closed forms.
Integral adaptive_lambert(std::span<const Vec3> outer, const Vec3& normal, std::span<const Vec3> inner,
                          double tolerance);

}  // namespace interflect::fem

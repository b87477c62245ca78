#pragma once

#include <span>

#include "core/vec.h"
#include "fem/space/plane_basis.h"

namespace interflect::fem {

/// What point_to_monomials gives in closed form, by Gauss rules on the triangles of a fan: of polygons that are small
/// for their distance it costs a tenth, and no terms cancel.
///
///   F_ij = h / pi int_P (n·r) / r^4 xi^i eta^j dA,      r = y - x,  h: height of x over the plane
///
/// 1/r^4 = R^-4 sum_n C_n^(2)(cos gamma) s^n about a triangle's centroid at the distance R, with s = |y - centroid| /
/// R, and |C_n^(2)| <= (n+1)(n+2)(n+3)/6.  A rule of degree D has all terms with n + 1 + i + j <= D, so that the first
/// one missed is n = D - i - j: the rule taken is the least of degree 2, 4, 6, 8 whose first missed term is at most
/// `accuracy` at the corners.
///
/// @param accuracy  of h A / (pi R³) times what monomials are at most, about
/// @param out       plane_functions(order) values; 0 where x lies in the plane or behind it
/// @return          whether all triangles are far enough; where not, `out` is left as it was
/// Test: tests/fem/polynomial_emitter.cpp
bool distant_monomials(const Vec3& x, const Vec3& n, std::span<const Vec3> polygon, const PlaneFrame& frame, int order,
                       double accuracy, std::span<double> out);

}  // namespace interflect::fem

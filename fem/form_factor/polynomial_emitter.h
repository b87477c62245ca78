#pragma once

#include <span>

#include "core/vec.h"
#include "fem/space/plane_basis.h"
#include "fem/space/polynomials.h"

namespace interflect::fem {

/// Irradiance at a point from a polygon whose radiosity is a monomial of its plane, in closed form:
///
///   F_ij = int_P cos cos / (pi r²) xi^i eta^j dA,   i + j <= order     (F_00 is Lambert's formula)
///
/// With the foot of x as origin, its height h over the plane, n = n_1 e_1 + n_2 e_2 + n_3 e_3, I_ij the integral of
/// xi^i eta^j / r^4, J_ij that over r² and L that of ln r²,
///
///   F_ij = h / pi (n_1 I_{i+1,j} + n_2 I_{i,j+1} - h n_3 I_ij)
///   I_ij = ((i - 1) J_{i-2,j} - line(xi^{i-1} eta^j m_1 / r²)) / 2,  i > 0, and likewise in eta;
///   2 h² I_00 = line(d / r²)
///   J_10 = line(m_1 ln r²) / 2,  J_11 = line(eta m_1 ln r²) / 2,  J_20 = (line(xi m_1 ln r²) - L) / 2
///   2 L = line(d ln r²) - 2 A + 2 h² J_00
///
/// by Gauss's theorem: lines are sums over edges, with the outward normal m and the edge's distance d from the foot, of
/// elementary integrals.  What is not elementary is J_00, a dilogarithm an edge: with phi from the foot, k = |d| / h,
/// q = (sqrt(1 + k²) - k)²,
///
///   J_00 = sum over edges of  sign(d) / 2 [ -phi ln q - Im Li2(-q e^{2 i phi}) + Im Li2(-e^{2 i phi}) ]
///
/// Normalisation: pi is inside, no reflectance.  Linear radiosity has this dilogarithm (as Clausen's integral) in
/// [Chen, Arvo 2000]; the derivation here is our own.
///
/// @param x, n     receiving point [m] and unit normal; no corner lies behind its horizon
/// @param polygon  corners [m], in the frame's plane, convex, counter-clockwise from x's side; 3 .. 16 of them
/// @param order    0 .. 3
/// @param out      plane_functions(order) values [m^(i+j)], by i + j and then by j; 0 where x lies in the plane or
///                 behind it
/// Accuracy: absolute about 1e-14 reach^(i+j), reach being the largest distance of a corner from the foot, and the
///           rounding of coordinates over h: for near points, since of far ones terms cancel.
/// Test: tests/fem/polynomial_emitter.cpp
void point_to_monomials(const Vec3& x, const Vec3& n, std::span<const Vec3> polygon, const PlaneFrame& frame, int order,
                        std::span<double> out);

}  // namespace interflect::fem

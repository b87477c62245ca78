#pragma once

#include <span>

#include "core/vec.h"
#include "fem/form_factor/edge_pair.h"
#include "fem/form_factor/integral.h"

namespace interflect::fem {

/// What a pair of edges adds to the double contour integral (edge_pair.h), by quadrature over e of the integral over
/// f:
///
///   I(e, f) = c int_e J ds,   J = int_f ln r dt = [ v (ln(m² + v²) - 2)/2 + m atan(v/m) ] between the ends of f
///
/// with c the cosine of their angle, m the distance of e's point from f's line and v the place along that.
///
/// As a function of a complex s, J is singular where the point meets an end Q of f, s = foot of Q on e's line +- i
/// distance, and where m = 0, on the lines' common perpendicular. e is halved until every such s is at least three
/// half-lengths from a part's middle: there the 10-point Gauss rule converges as (3 + sqrt 8)^-20 = 5e-16. Towards a
/// singular s on e itself, where edges touch, cross or lie on one line, parts are halved down to 1e-9 of it; J is
/// bounded there, and what is left errs by the square of that. Edges that are one have L² (ln L - 3/2).
///
/// @return  I and an estimate of its rounding, which does not grow where edges are nearly parallel
///
/// Accuracy: about 1e-15 times the product of the lengths, where distances are about 1.
Integral edge_pair_by_quadrature(const Edge& e, const Edge& f);

/// K of two polygons by the double contour integral, every pair of edges by quadrature [m²]:
///
///   K = A_1 F_12 = 1/(2 pi) sum_{e of 1} sum_{f of 2} I(e, f)
///
/// What the closed form (polygon_pair.h) is checked against; the same arguments, accuracy and limits, no dilogarithm.
///
/// Source: [Goral, Torrance, Greenberg, Battaile 1984].  Test: tests/fem/closed_form_pairs.cpp
Integral double_contour(std::span<const Vec3> a, std::span<const Vec3> b);

}  // namespace interflect::fem

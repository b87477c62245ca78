#pragma once

#include <span>

#include "core/vec.h"
#include "fem/form_factor/integral.h"

namespace interflect::fem {

/// K of two polygons in closed form, unoccluded, by the double contour integral (Stokes' theorem on both):
///
///   K = A_1 F_12 = 1/(2 pi) sum_{e of 1} sum_{f of 2} int_e int_f ln r dr_e . dr_f
///
/// Every pair of edges has a closed form (edge_pair.h): elementary where they meet in a corner, are parallel or lie
/// on one line, with dilogarithms else. Edges that are nearly parallel lose digits as 1 / angle: while the errors are
/// above `tolerance` K, the pair of edges with the largest is integrated by quadrature instead (contour.h).
///
/// @param a, b  corners [m] of planar rings, any number of them, convex or not, counter-clockwise seen from the side
///          that exchanges light; neither has a part behind the other's plane (clip first); they may touch, but not
///          cross
/// @return  K [m²], and what its rounding is estimated to be at most (99 % of pairs): near by, about 1e-16 times the
///          product of the perimeters. How that compares with K is for the caller to see: relative to K it grows as
///          (distance / diameter)^3 and more where polygons are far apart, and where they are nearly edge-on.
///
/// Lengths times 2^k give the same digits.
///
/// Source: [Goral, Torrance, Greenberg, Battaile 1984]; [Schroeder, Hanrahan 1993].
///
/// Test: tests/fem/closed_form_pairs.cpp
Integral polygon_pair(std::span<const Vec3> a, std::span<const Vec3> b, double tolerance);

}  // namespace interflect::fem

#pragma once

#include <optional>

#include "fem/form_factor/element_shapes.h"

namespace interflect::fem {

/// K by a product rule on both elements [m²]:
///
///   K = 1/pi sum_a sum_b  w_a h_j(x_a)  w_b h_i(y_b) / |x_a - y_b|^4,   h_i(y) = n_i . (y - c_i)
///
/// The numerator cos cos r² of the kernel is the product of the two nodes' heights over each other's planes, linear in
/// either node, so that only 1/r^4 is approximated.  Both elements lie in front of each other's planes.
double far_field(const NodeArrays& a, const geometry::Plane& plane_a, const NodeArrays& b,
                 const geometry::Plane& plane_b);

/// How two elements lie to the line between their centroids: what far-field errors are made of.
struct FarPair {
  /// Of the axes of the first element, and then of those of the second.
  using PerAxis = std::array<double, 8>;
  alignas(32) PerAxis reach;  ///< t: its length over the distance of the elements
  alignas(32) PerAxis sine2;  ///< sin² gamma of its angle to the line
  alignas(32) PerAxis slope;  ///< (1 + s / H) (1 + w / t), by its share in the mean over axes of one kind
  std::size_t of_first, count;
  bool triangles[2];  ///< whose rules differ from those of quads
  double q;           ///< radii over distance
};
FarPair far_pair(const ElementShape& a, const ElementShape& b);

/// Estimated error of K_l, by rules_of(l + 1) on either element, as a part of K.
///
/// From a point of the other element, at distance r and height H r, the kernel along an axis u through the centroid is
///
///   h(x + t r u) / |..|^4 = r^-3 (H + s t) sum_m C_m(cos gamma) t^m
///
/// with the slope s of the axis against the other's plane, its angle gamma to the line, and C_m the Gegenbauer
/// polynomials of index 2, of which 1 / r^4 is the generating function [Szego 1939, 4.7.23].  Gauss rules of n nodes
/// err on t^2n, for a half side of length t r, by g_n t^2n, g_n = 2^2n n!^4 / ((2n + 1) (2n)!²).  So a quad, whose
/// Jacobian grows by w from the middle to the end of an axis, has to leading order the error
///
///   sum over its two axes of  g_n t^2n |C_2n + (s / H + w / t) C_2n-1 + (s / H) (w / t) C_2n-2|
///
/// an axis being the mean of two opposite sides.  Rules of degree d on triangles err in the same way on degrees d + 1
/// and d + 2, but on what swings 0, 3, 6 or 9 times a turn only; their three axes go to the corners, and the mean is
/// taken.  Polynomials may be 0 by chance: for each of them stands (m + 2) / (2 sin² gamma + (m + 2) / C_m(1)), which
/// is C_m(1) at gamma = 0, with the largest m.  What follows the leading order counts as if the distance were smaller
/// by 0.3 q².  The errors of the two elements add.
///
/// Fitted are that 0.3, a factor for quads and one for each rule of triangles: to random pairs, half of them long and
/// edge-on, some clipped, some no parallelograms, with sizes up to 10 : 1 and q up to 0.7, and to pairs of a room's
/// walls.  The error is below the estimate in 99 % of each kind, and in the median a fifth of it (a tenth with quads
/// that are no parallelograms, a twentieth with the last rule of triangles).  An estimate, not a proof.
/// Test: tests/fem/far_field.cpp, against adaptive Lambert quadrature.
double far_field_error(int level, const FarPair& pair);

struct FarRule {
  int level;
  double error;  ///< as a part of K
};
/// The first rule whose error is at most `tolerance`.
std::optional<FarRule> far_rule(const FarPair& pair, double tolerance);

}  // namespace interflect::fem

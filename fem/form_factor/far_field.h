#pragma once

#include "fem/form_factor/element_shapes.h"

namespace interflect::fem {

/// K by a product rule on both elements [m²]:
///
///   K = 1/pi sum_a sum_b  w_a h_j(x_a)  w_b h_i(y_b) / |x_a - y_b|^4,   h_i(y) = n_i . (y - c_i)
///
/// The numerator cos cos r² of the kernel is the product of the two nodes' heights over each other's planes, linear in either
/// node, so that only 1/r^4 is approximated.  Both elements lie in front of each other's planes.
double far_field(const NodeArrays& a, const geometry::Plane& plane_a, const NodeArrays& b,
                 const geometry::Plane& plane_b);

/// Bound on the relative error of `far_field` with rules_of(level + 1) on either element:
///
///   |error| / K <= c_l q^(2l+1) (q + slope),   q = (radius_i + radius_j) / distance of the centroids
///
/// `slope` is the larger of the relative variations (max - min) / (max + min) of the heights of one element over the other's
/// plane: where the linear numerator varies much, the odd term of 1/r^4 counts as well.  The form follows from Taylor's
/// expansion; the constants c = 2.2, 1.1, 0.46, 0.15 are 1.5 times the largest seen among 10^5 random pairs: an estimate, not
/// a proof.
/// Test: tests/fem/far_field.cpp, against adaptive Lambert quadrature.
double far_field_error(int level, double q, double slope);

/// The lowest level with an error of at most `tolerance`; ElementShapes::levels where none has.
int far_field_level(double q, double slope, double tolerance);

}  // namespace interflect::fem

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

/// What a far-field integral's error is estimated from.
enum class FarPair { with_quads, of_triangles };

/// Estimated error of K_l, by rules_of(l + 1) on either element, l >= 1, from how much it differs from K_{l-1} [m²]:
///
///   c_l ( q^m |K_l - K_{l-1}| + f_l q^p K_l ),   q = (radius_i + radius_j) / distance of the centroids
///
/// The difference is the error of the step before, and rules gain a power of q a step; the second term is what is typical at that distance,
/// since a difference may be small by chance.  Exponents and constants were fitted to 35 000 random pairs each of quads, and of
/// triangles, with sizes up to 10 : 1 and q up to 0.7: the error is below the estimate in 99 % of them, and a tenth of it in the
/// median (pairs with a quad in them; triangles alike up to l = 2, a thirtieth for l = 3).  An estimate, not a proof.
/// Test: tests/fem/far_field.cpp, against adaptive Lambert quadrature.
double far_field_error(int level, FarPair pair, double q, double difference, double K);

/// The lowest level >= 1 that is worth a try: whose error is typically at most `tolerance` K; ElementShapes::levels where none is.
int far_field_level(FarPair pair, double q, double tolerance);

}  // namespace interflect::fem

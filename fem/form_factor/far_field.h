#pragma once

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

/// How two elements lie to each other: what far-field errors are estimated from.
struct FarPair {
  struct Element {
    double q;       ///< radius / distance of the centroids
    bool triangle;  ///< rules of triangles differ from those of quads
  };
  Element a, b;
  double cosine;  ///< the smaller one of the two to the line of the centroids

  double q() const { return a.q + b.q; }
  double steepness() const { return cosine + 0.03 * q(); }
};
FarPair far_pair(const ElementShape& a, const ElementShape& b);

/// Estimated error of K_l, by rules_of(l + 1) on either element, l >= 1, from how much it differs from K_{l-1} [m²]:
///
///   sum over the two elements of  c_l ( q^m |K_l - K_{l-1}| + f_l q^p K_l / (cosine + 0.03 (q_a + q_b)) )
///
/// The difference is the error of the step before, and rules gain a power of q a step; the second term is what is
/// typical at that distance, since a difference may be small by chance, and grows where one element is seen edge-on,
/// whose heights then vary by as much as they are.  To leading order the errors of the two elements' rules add, and so
/// do the terms. Exponents and constants, apart for triangles and quads, were fitted to 24 000 random pairs each, half
/// of them long and edge-on, with sizes up to 10 : 1 and q_a + q_b up to 0.7, and to 16 000 pairs of a room's walls:
/// the error is below the estimate in 99 % of them, and in the median a sixth of it at random pairs (a twelfth for l =
/// 3), between a room's walls a ninth to a twentieth.  An estimate, not a proof. Test: tests/fem/far_field.cpp, against
/// adaptive Lambert quadrature.
double far_field_error(int level, const FarPair& pair, double difference, double K);

/// The lowest level >= 1 that is worth a try: whose error is typically at most `tolerance` K; ElementShapes::levels
/// where none is.
int far_field_level(const FarPair& pair, double tolerance);

}  // namespace interflect::fem

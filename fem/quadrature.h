#pragma once

#include <span>
#include <vector>

#include "core/vec.h"

/// Integration over triangles and quads.
namespace interflect::fem {

/// A node of a rule on a reference element: barycentric (u, v) on the triangle (0,0) (1,0) (0,1), or [0,1]² on the
/// quad.
struct RuleNode {
  double u, v;
  double weight;  ///< the weights of a rule sum to 1
};
using Rule = std::vector<RuleNode>;

/// A node on an element in space.
struct SurfaceNode {
  Vec3 position;
  double weight;  ///< [m²], Jacobian included: the weights of an element sum to its area
};

/// Gauss-Legendre nodes and weights (as u and weight; v = 0) on [0, 1], exact for polynomials of degree 2 points - 1.
/// Newton's iteration on the recurrence of P_n, to rounding.  @throws core::PreconditionError  if points < 1
Rule gauss_legendre(int points);

/// Tensor product of Gauss-Legendre rules: points² nodes, exact for degree 2 points - 1 in each of u and v.
Rule quad_rule(int points);

/// Symmetric rule with positive weights, all nodes inside, exact for polynomials of total degree <= `degree`, 0 .. 8.
/// Source: [Dunavant 1985], table II, and [Strang, Fix 1973]; 1, 3, 6, 7, 12 or 16 nodes.
/// @throws core::PreconditionError  outside 0 .. 8.  Test: tests/fem/quadrature.cpp, by all monomials.
Rule triangle_rule(int degree);

/// Rules of degree 3 with nodes in the corners, the middles of the sides and the centroid, the first: Simpson's on
/// quads, on triangles 9/20 at the centroid, 2/15 at each middle, 1/20 at each corner [Hammer, Stroud 1956].  Test:
/// tests/fem/quadrature.cpp, by all monomials.
Rule closed_triangle_rule();
Rule closed_quad_rule();

/// A triangle's rule and a quad's, to be used side by side.
struct RulePair {
  Rule triangle, quad;
  const Rule& of(std::size_t corners) const { return corners == 3 ? triangle : quad; }
};
/// Quads by points² Gauss nodes, triangles by the rule of degree 1, 4, 6 or 8: no worse, with positive weights;
/// 1 <= points <= 4.
RulePair rules_of(int points);

/// Position at (u, v): affine on two corners (by u alone) and three, bilinear on four, as mesh::ElementPoint counts
/// them.
Vec3 point_on(std::span<const Vec3> ring, double u, double v);

/// |d position / du x d position / dv| [m²]; on a triangle twice its area; on a segment its length [m].
///
/// On a planar quad the bilinear terms of the product vanish, so that it is linear in (u, v) and even one Gauss node
/// has the exact area.
double jacobian(std::span<const Vec3> ring, double u, double v);

/// The rule's nodes on a planar triangle or convex quad, appended to `out`.
void append_nodes(std::span<const Vec3> ring, const Rule& rule, std::vector<SurfaceNode>& out);

}  // namespace interflect::fem

#pragma once

#include "fem/pair_rule.h"

namespace interflect::fem {

/// Places on two triangles at once, for those that share an edge, the first one of either, or the first corner, or
/// nothing.
struct TrianglePairPlaces {
  explicit TrianglePairPlaces(int points);

  struct Place {
    double a_1, a_2, b_1, b_2;  ///< by edges from the first corner
    double weight;              ///< of twice the areas
  };
  std::vector<Place> edge, corner;
  std::vector<Rule> apart;  ///< on a triangle, by points, of twice its area: products of two are for pairs
};

/// Of triangles and convex quads in space that do not cross, for kernels that are smooth but where x = y, and
/// homogeneous of degree -2 in y - x, as cos cos / r² is.
///
/// Each panel is clipped to what lies in front of the other one's plane, and cut into triangles, at corners of the
/// other one too where those lie on it.  So two triangles have an edge in common, a corner, or nothing:
///
/// - An edge, from p along e, with f and g from p to the third corners: x = p + z e + s f, y = p + (z + w) e + t g, and
///   y - x = w e + t g - s f depends on (w, s, t) alone.  Over w >= 0, z goes from 0 to 1 - max(s, t + w); w < 0 is the
///   same of x and y swapped.  With xi = max(s, t + w), (w, s, t) = xi times a point of two faces, the Jacobian is
///   xi², which takes the singularity away.
/// - A corner p: x = p + a X, y = p + b Y with X and Y on the edges opposite to it.  Where b = a tau, tau <= 1, and
///   where it is the other way round, the Jacobian is a³ tau.  The larger one is cut in two until they are of one size.
/// - Nothing: products, after the larger one is cut in two until they are as far apart as they are long.
///
/// What is left is a polynomial in xi, z and a, which few points do exactly for the functions of ElementBasis, and
/// analytic in the other variables: Gauss rules of n points each, and of half as many of what has nothing in common,
/// converge exponentially in n, the slower the sharper the angle between the panels and the longer the triangles.  The
/// number of nodes is of the order n² to n^4, times the square of length over gap for panels that nearly touch all
/// along, up to a gap of some hundredth; closer ones are integrated less accurately.
/// Source: regularising coordinates as in [Sauter, Schwab 2011], 5.2, in decompositions of our own.
/// Test: tests/fem/space/polygon_pair_rule.cpp
class PolygonPairRule final : public PairRule {
 public:
  /// @throws core::PreconditionError  if points < 1
  explicit PolygonPairRule(int points);
  /// @throws core::PreconditionError  segments
  void for_nodes(const Panel& a, const Panel& b, const Visit& visit) const override;

 private:
  TrianglePairPlaces places_;
};

}  // namespace interflect::fem

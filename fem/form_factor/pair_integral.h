#pragma once

#include "fem/form_factor/element_shapes.h"
#include "fem/form_factor/integral.h"

namespace interflect::fem {

/// How two elements lie to each other's planes.
enum class Facing {
  away,      ///< one lies behind the other's plane, or in it: nothing is exchanged
  crossing,  ///< one reaches through the other's plane: both are clipped first
  full       ///< each is wholly in front of the other
};

struct PairIntegral {
  Facing facing = Facing::away;
  double value = 0;  ///< K_ij = A_i F_ij, as if nothing lay between [m²]
  double error = 0;  ///< estimated bound on its quadrature error [m²]
};

/// A clipped element as triangles and quads.
struct Pieces {
  std::array<ElementShape, 4> shape;
  std::size_t count = 0;
};
Pieces pieces_in_front(const ElementShape& of, const geometry::Plane& plane);

/// Unoccluded form factors of pairs, each by the cheapest of four ways that states to be within the tolerance:
///
/// 1. far pairs by a product rule on both elements, of the lowest order that will do (far_field.h);
/// 2. rectangles along common axes in closed form (rectangle_pair.h);
/// 3. where no corner or edge is near, Lambert's formula on one and one Gauss rule on the other (adaptive_lambert.h).
///    The outer element is the smaller one: the integrand over it varies on the scale of the distance, which is the
///    same for both choices, and so it is the smoother the smaller the outer element is;
/// 4. near and touching pairs in closed form (polygon_pair.h).
///
/// What no closed form can do, because what is summed cancels (slivers, polygons nearly edge-on, or far apart at
/// tolerances below 1e-9), is left to adaptive cells of Lambert's formula.
///
/// K is in [0, min(A_i, A_j)]; lengths times 2^k give the same digits.
///
/// Accuracy: the true error is below the stated one in 99 % of pairs. The stated one is within the tolerance down to
/// 1e-13, but for pairs whose K is below about 4e-3 min(A), as of elements nearly in one plane: those may miss 1e-12
/// and less.
///
/// Test: tests/fem/closed_form_pairs.cpp, tests/fem/stated_errors.cpp
class PairIntegrator {
 public:
  PairIntegrator(std::span<const scene::SurfacePatch> patches, double tolerance)
      : shapes_(patches), tolerance_(tolerance) {}

  PairIntegral operator()(Index i, Index j) const;
  const ElementShapes& shapes() const { return shapes_; }

 private:
  template <class FarField>
  Integral unclipped(const ElementShape& a, const ElementShape& b, const FarField& far) const;
  Integral clipped_pair(const ElementShape& a, const ElementShape& b) const;

  ElementShapes shapes_;
  double tolerance_;  ///< relative
};

}  // namespace interflect::fem

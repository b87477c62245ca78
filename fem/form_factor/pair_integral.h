#pragma once

#include "fem/form_factor/adaptive_lambert.h"
#include "fem/form_factor/element_shapes.h"

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

/// Unoccluded form factors of pairs.
///
/// Far pairs take a product rule on both elements, of the lowest order whose estimated error is below the tolerance
/// (far_field.h); near and touching ones Lambert's formula on one and adaptive Gauss quadrature on the other
/// (adaptive_lambert.h).  The outer element is the smaller one: the integrand over it varies on the scale of the distance,
/// which is the same for both choices, and so it is the smoother the smaller the outer element is.
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

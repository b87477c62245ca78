#pragma once

#include <array>
#include <optional>
#include <vector>

#include "fem/form_factor/element_shapes.h"
#include "fem/form_factor/method.h"
#include "fem/form_factor/moment_integrand.h"
#include "fem/form_factor/pair_integral.h"

namespace interflect::fem {

/// A block of K, and what each of its entries errs by at most, as estimated [m²].
struct PairMoments {
  Moments value;
  double error = 0;
};

/// Of the functions that a pair has: the higher degree of its elements.
int pair_degree(const FormFactorContext& context, Index i, Index j);

/// Adds a block's entries at the unknowns of elements i and j.
/// @param stride          unknowns an element, of which a block may have fewer: the first ones
/// @param standard_error  of every entry [m²]
void write_block(Index i, Index j, Index stride, const PairMoments& block, double standard_error, ExchangeSink& sink);

/// Blocks of K of polynomials on pairs of elements, as if nothing lay between:
///
/// 1. pairs that are apart by a product rule on both elements, with as many nodes more than constants need
/// (far_field.h)
///    as the polynomials take of its degrees, up to 7 a side.  The error is taken from the difference to the rule with
///    one node a side less, of which what Bernstein's ellipse knows is left, by how far they are apart and how long.
/// 2. others by the closed form for one point (polynomial_emitter.h) inside and adaptive cells of Gauss rules outside
///    (adaptive_cells.h), on the smaller element.  Touching elements, too: the inner integral is exact, and what is
///    left is bounded and rough at the common edge alone, where cells shrink.
///
/// Elements that reach through each other's planes are clipped first.
class MomentIntegrator {
 public:
  static constexpr int most_points = 7;  ///< of a product rule, a side

  /// @param tolerance  of each entry, relative to K_00
  MomentIntegrator(const ElementShapes& shapes, int order, double tolerance);

  /// @param constants  the pair's K_00: `facing` not away
  PairMoments operator()(Index i, Index j, const PairIntegral& constants) const;
  const PlaneBasis& basis(Index i) const { return bases_[static_cast<std::size_t>(i)]; }
  int order() const { return order_; }
  Index functions() const { return plane_functions(order_); }  ///< of any element

 private:
  PairMoments unclipped(Index i, const ElementShape& a, Index j, const ElementShape& b, double tolerance) const;
  std::optional<PairMoments> far(Index i, const ElementShape& a, Index j, const ElementShape& b,
                                 double tolerance) const;
  Moments by_products(Index i, const ElementShape& a, Index j, const ElementShape& b, int points) const;

  const ElementShapes& shapes_;
  int order_;
  double tolerance_;
  std::array<RulePair, most_points> rules_;
  std::vector<PlaneBasis> bases_;
};

}  // namespace interflect::fem

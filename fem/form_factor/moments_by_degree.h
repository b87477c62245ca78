#pragma once

#include <vector>

#include "fem/form_factor/pair_moments.h"

namespace interflect::fem {

/// Blocks of K of polynomials on elements, of one order or of degrees of their own: a pair has the functions of the
/// higher degree of its elements.
class MomentsByDegree {
 public:
  /// @param context  of an order of 1 .. 3, and degrees of 1 .. order if any
  /// @throws core::PreconditionError
  MomentsByDegree(const FormFactorContext& context, const ElementShapes& shapes);

  /// Of the degree that the pair needs.
  const MomentIntegrator& of(Index i, Index j) const;
  /// Of the context's order.
  const PlaneBasis& basis(Index i) const { return moments_.back().basis(i); }

 private:
  FormFactorContext context_;
  std::vector<MomentIntegrator> moments_;  ///< of order 1, 2, .. where any pair needs it; the last is of all the order
};

}  // namespace interflect::fem

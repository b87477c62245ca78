#pragma once

#include <span>
#include <vector>

#include "fem/form_factor/method.h"
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
  /// @param standard_error  of every entry: functions are orthonormal in the mean
  void write(Index i, Index j, const PairMoments& block, double standard_error, ExchangeSink& sink) const;

 private:
  Index functions_;
  std::span<const int> degrees_;
  std::vector<MomentIntegrator> moments_;  ///< of order 1, 2, .. where any pair needs it; the last is of all the order
};

}  // namespace interflect::fem

#pragma once

#include "fem/form_factor/pair_method.h"
#include "fem/form_factor/pair_moments.h"
#include "fem/form_factor/pair_visibility.h"

namespace interflect::fem {

/// Methods of polynomials on elements that know a pair's block as if nothing lay between: of pairs whose visibility is
/// in doubt, rays tell what is left of it (seen_block.h).
///
/// Standard errors: that of V times K_00,unoccluded for every entry, since functions are orthonormal in the mean, and
/// products of two are of the size of 1.
class SampledBlocks : public PairMethod {
 public:
  int highest_order() const override { return ElementBasis::highest_order; }

 protected:
  explicit SampledBlocks(const FormFactorContext& context);

  /// As if nothing lay between, of the functions that the pair's degrees want: functions are ordered by degree, so
  /// they are the first ones of `basis`.
  virtual PairMoments block(Index i, Index j, const PairIntegral& K) const = 0;
  /// Of the context's order.
  virtual const PlaneBasis& basis(Index i) const = 0;

 private:
  class Work;
  std::unique_ptr<PairWork> work() const final;

  PairVisibility visibility_;
};

}  // namespace interflect::fem

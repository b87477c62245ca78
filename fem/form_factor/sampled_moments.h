#pragma once

#include "fem/form_factor/moments_by_degree.h"
#include "fem/form_factor/sampled_blocks.h"

namespace interflect::fem {

/// `gauss-lambert` for polynomials on elements.
class SampledMoments final : public SampledBlocks {
 public:
  /// @throws core::PreconditionError  an order that is not 1 .. 3
  explicit SampledMoments(const FormFactorContext& context);
  std::string name() const override { return "gauss-lambert"; }

 private:
  PairMoments block(Index i, Index j, const PairIntegral& K) const override { return moments_.of(i, j)(i, j, K); }
  const PlaneBasis& basis(Index i) const override { return moments_.basis(i); }

  MomentsByDegree moments_;
};

}  // namespace interflect::fem

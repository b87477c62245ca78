#pragma once

#include "fem/form_factor/moments_by_degree.h"
#include "fem/form_factor/pair_method.h"
#include "fem/form_factor/visibility.h"

namespace interflect::fem {

/// `gauss-lambert` for polynomials on elements: blocks of pairs whose visibility is in doubt by rays (seen_block.h).
///
/// Standard errors: that of V times K_00,unoccluded for every entry, since functions are orthonormal in the mean, and
/// products of two are of the size of 1.
class SampledMoments final : public PairMethod {
 public:
  explicit SampledMoments(const FormFactorContext& context);
  std::string name() const override { return "gauss-lambert"; }
  int highest_order() const override { return ElementBasis::highest_order; }

 private:
  class Work;
  std::unique_ptr<PairWork> work() const override;

  MomentsByDegree moments_;
  VisibilitySampler visibility_;
};

}  // namespace interflect::fem

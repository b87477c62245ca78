#pragma once

#include "fem/form_factor/moments_by_degree.h"
#include "fem/form_factor/pair_method.h"
#include "fem/form_factor/visibility.h"

namespace interflect::fem {

/// `gauss-lambert` for polynomials on elements: blocks of pairs whose visibility is in doubt from rays between points
/// x_k and y_k with weights k_k = cos cos / r² (visibility.h), v_k = 1 where they see each other,
///
///   V = sum k_k v_k / sum k_k,
///   K_ab = V K_ab,unoccluded + K_00,unoccluded sum_k k_k (v_k - V) N_a(x_k) N_b(y_k) / sum_k k_k
///
/// The first term is what a part that hides evenly leaves, without any noise beyond that of V; the second one is what
/// rays know of where it hides, and is 0 where all of them agree.  K_00 is that of constants, by the same rays.
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

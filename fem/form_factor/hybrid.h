#pragma once

#include "core/random.h"
#include "fem/form_factor/pair_method.h"

namespace interflect::fem {

/// Analytic inside, numerical outside, after [Baum, Rushmeier, Winget 1989] equation (8):
///
///   K_ij = sum_k w_k F_{dA(x_k) -> j} V_k     x_k: Gauss points of i, w_k [m²];  F by Lambert's formula, exact;
///                                             V_k: the part of j that x_k sees, by rays to stratified points of j
///
/// i, the smaller of the two, is cut in four until they are small beside their distance from j: it is proximity that
/// one point does not stand for.  The sum only gives the visible part, V = K_ij / K_ij,unoccluded: the latter is known
/// better (pair_integral.h). A pair whose standard error is above the tolerance is handed to exact subtraction
/// (exact_occlusion.h).
class Hybrid final : public PairMethod {
 public:
  explicit Hybrid(const FormFactorContext& context)
      : PairMethod(context), seed_(core::derived_seed(context.seed, "hybrid")) {}
  std::string name() const override { return "hybrid"; }

 private:
  class Points;
  std::unique_ptr<PairWork> work() const override;

  std::uint64_t seed_;
};

}  // namespace interflect::fem

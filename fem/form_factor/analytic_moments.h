#pragma once

#include "fem/form_factor/moments_by_degree.h"
#include "fem/form_factor/pair_method.h"

namespace interflect::fem {

/// `analytic` for polynomials on elements: blocks of K, with what hides parts of a pair subtracted exactly,
///
///   K_ab = K_ab,unoccluded - int_i N_a(x) (irradiance at x from the hidden part of j that sends N_b) dA
///
/// as hidden_exchange.h does it for constants; the irradiance is in closed form too (polynomial_emitter.h).  The sink
/// gets unknowns, element after element.
class AnalyticMoments final : public PairMethod {
 public:
  /// @throws core::PreconditionError  an order that is not 1 .. 3
  explicit AnalyticMoments(const FormFactorContext& context);
  std::string name() const override { return "analytic"; }
  int highest_order() const override { return ElementBasis::highest_order; }

 private:
  class Work;
  std::unique_ptr<PairWork> work() const override;

  MomentsByDegree moments_;
};

}  // namespace interflect::fem

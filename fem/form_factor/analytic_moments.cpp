#include "fem/form_factor/analytic_moments.h"

#include "core/error.h"
#include "fem/form_factor/hidden_pairs.h"

namespace interflect::fem {

class AnalyticMoments::Work final : public PairWork {
 public:
  explicit Work(const AnalyticMoments& method)
      : moments_(method.moments_),
        hidden_(method.shapes(), method.blockers(), method.context().tolerance),
        accuracy_(0.1 * method.context().tolerance) {}

  void clear(Index i, Index j, const PairIntegral& K, ExchangeSink& sink) override {
    write(i, j, moments_(i, j, K), sink);
  }
  void doubtful(const DoubtfulPair& pair, ExchangeSink& sink, PairCounts& counts) override {
    const PlaneBasis &of_i = moments_.basis(pair.i), &of_j = moments_.basis(pair.j);
    PairMoments hidden{Moments::Zero(of_i.size(), of_j.size()), 0};
    const bool all = hidden_(
        pair, counts,
        [&](const ElementShape& outer, bool i_is_outer) {
          return MomentIntegrand(i_is_outer ? of_i : of_j, outer.plane.normal, i_is_outer ? of_j : of_i, accuracy_);
        },
        [&](const HiddenIntegralOf<Moments>& part, bool i_is_outer) {
          if (i_is_outer)
            hidden.value += part.value;
          else
            hidden.value += part.value.transpose();
          hidden.error += part.error;
        });
    if (all) return;
    PairMoments block = moments_(pair.i, pair.j, pair.unoccluded);
    block.value -= hidden.value;
    block.error += hidden.error + accuracy_ * pair.unoccluded.value;
    write(pair.i, pair.j, block, sink);
  }

 private:
  void write(Index i, Index j, const PairMoments& block, ExchangeSink& sink) const {
    const Index n = moments_.functions();
    for (Index a = 0; a < n; ++a)
      for (Index b = 0; b < n; ++b) sink.add(i * n + a, j * n + b, {block.value(a, b), 0, block.error});
  }

  const MomentIntegrator& moments_;
  HiddenPairs<MomentIntegrand> hidden_;
  double accuracy_;  ///< of far parts' irradiance, relative
};

AnalyticMoments::AnalyticMoments(const FormFactorContext& context)
    : PairMethod(context), moments_(shapes(), context.order, context.tolerance) {
  if (context.order < 1 || context.order > ElementBasis::highest_order)
    throw core::PreconditionError("AnalyticMoments: an order of 1 .. 3 expected");
}

std::unique_ptr<PairWork> AnalyticMoments::work() const { return std::make_unique<Work>(*this); }

}  // namespace interflect::fem

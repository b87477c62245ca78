#include "fem/form_factor/analytic_moments.h"

#include "fem/form_factor/hidden_pairs.h"

namespace interflect::fem {

class AnalyticMoments::Work final : public PairWork {
 public:
  explicit Work(const AnalyticMoments& method)
      : moments_(method.moments_),
        stride_(plane_functions(method.context().order)),
        hidden_(method.shapes(), method.blockers(), method.context().tolerance),
        accuracy_(0.1 * method.context().tolerance) {}

  void clear(Index i, Index j, const PairIntegral& K, ExchangeSink& sink) override {
    write_block(i, j, stride_, moments_.of(i, j)(i, j, K), 0, sink);
  }
  void doubtful(const DoubtfulPair& pair, ExchangeSink& sink, PairCounts& counts) override {
    const MomentIntegrator& moments = moments_.of(pair.i, pair.j);
    const PlaneBasis &of_i = moments.basis(pair.i), &of_j = moments.basis(pair.j);
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
    PairMoments block = moments(pair.i, pair.j, pair.unoccluded);
    block.value -= hidden.value;
    block.error += hidden.error + accuracy_ * pair.unoccluded.value;
    write_block(pair.i, pair.j, stride_, block, 0, sink);
  }

 private:
  const MomentsByDegree& moments_;
  Index stride_;
  HiddenPairs<MomentIntegrand> hidden_;
  double accuracy_;  ///< of far parts' irradiance, relative
};

AnalyticMoments::AnalyticMoments(const FormFactorContext& context)
    : PairMethod(context), moments_(this->context(), shapes()) {}

std::unique_ptr<PairWork> AnalyticMoments::work() const { return std::make_unique<Work>(*this); }

}  // namespace interflect::fem

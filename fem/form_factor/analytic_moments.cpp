#include "fem/form_factor/analytic_moments.h"

#include <algorithm>

#include "core/error.h"
#include "fem/form_factor/hidden_pairs.h"

namespace interflect::fem {

class AnalyticMoments::Work final : public PairWork {
 public:
  explicit Work(const AnalyticMoments& method)
      : method_(method),
        hidden_(method.shapes(), method.blockers(), method.context().tolerance),
        accuracy_(0.1 * method.context().tolerance) {}

  void clear(Index i, Index j, const PairIntegral& K, ExchangeSink& sink) override {
    write(i, j, method_.moments(i, j)(i, j, K), sink);
  }
  void doubtful(const DoubtfulPair& pair, ExchangeSink& sink, PairCounts& counts) override {
    const MomentIntegrator& moments = method_.moments(pair.i, pair.j);
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
    write(pair.i, pair.j, block, sink);
  }

 private:
  void write(Index i, Index j, const PairMoments& block, ExchangeSink& sink) const {
    const Index n = plane_functions(method_.context().order);
    for (Index a = 0; a < block.value.rows(); ++a)
      for (Index b = 0; b < block.value.cols(); ++b)
        sink.add(i * n + a, j * n + b, {block.value(a, b), 0, block.error});
  }

  const AnalyticMoments& method_;
  HiddenPairs<MomentIntegrand> hidden_;
  double accuracy_;  ///< of far parts' irradiance, relative
};

AnalyticMoments::AnalyticMoments(const FormFactorContext& context) : PairMethod(context) {
  if (context.order < 1 || context.order > ElementBasis::highest_order)
    throw core::PreconditionError("AnalyticMoments: an order of 1 .. 3 expected");
  for (const int degree : context.degrees)
    if (degree < 1 || degree > context.order)
      throw core::PreconditionError("AnalyticMoments: degrees of 1 .. order expected");
  const int lowest = context.degrees.empty() ? context.order : 1;
  for (int order = lowest; order <= context.order; ++order) moments_.emplace_back(shapes(), order, context.tolerance);
}

const MomentIntegrator& AnalyticMoments::moments(Index i, Index j) const {
  const std::span<const int> degrees = context().degrees;
  if (degrees.empty()) return moments_.back();
  const auto degree = [&](Index element) { return degrees[static_cast<std::size_t>(element)]; };
  return moments_[static_cast<std::size_t>(std::max(degree(i), degree(j)) - 1)];
}

std::unique_ptr<PairWork> AnalyticMoments::work() const { return std::make_unique<Work>(*this); }

}  // namespace interflect::fem

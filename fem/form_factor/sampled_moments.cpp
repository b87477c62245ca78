#include "fem/form_factor/sampled_moments.h"

#include <numeric>

#include "fem/form_factor/sampled_pair.h"

namespace interflect::fem {

class SampledMoments::Work final : public PairWork {
 public:
  explicit Work(const SampledMoments& method) : method_(method) {}

  void clear(Index i, Index j, const PairIntegral& K, ExchangeSink& sink) override {
    method_.moments_.write(i, j, method_.moments_.of(i, j)(i, j, K), 0, sink);
  }
  void doubtful(const DoubtfulPair& pair, ExchangeSink& sink, PairCounts& counts) override {
    const double K_00 = pair.unoccluded.value;
    const SampledVisibility v = sampled(pair, method_.shapes(), method_.visibility_, workspace_, counts);
    const MomentIntegrator& moments = method_.moments_.of(pair.i, pair.j);
    PairMoments block = moments(pair.i, pair.j, pair.unoccluded);
    block.value *= v.visible;
    if (v.visible > 0 && v.visible < 1 && v.rays > 0) {
      Moments where = moments_of_what_is_seen(moments.basis(pair.i), moments.basis(pair.j), v.visible);
      where(0, 0) = 0;  // but for rounding
      block.value += K_00 * where;
    }
    method_.moments_.write(pair.i, pair.j, block, K_00 * v.standard_error, sink);
  }

 private:
  /// sum_k k_k (v_k - V) N_a(x_k) N_b(y_k) / sum_k k_k, of the rays that were cast last.
  Moments moments_of_what_is_seen(const PlaneBasis& of_i, const PlaneBasis& of_j, double visible) const {
    const Vec3& origin = method_.shapes().origin();
    const double all = std::accumulate(workspace_.weights.begin(), workspace_.weights.end(), 0.0);
    Moments sum = Moments::Zero(of_i.size(), of_j.size());
    for (std::size_t k = 0; k < workspace_.segments.size(); ++k) {
      const raycast::Segment& ray = workspace_.segments[k];
      const double seen = workspace_.blocked[k] == 0 ? 1 : 0;
      sum += (workspace_.weights[k] / all * (seen - visible)) * of_i.at(ray.from - origin) *
             of_j.at(ray.to - origin).transpose();
    }
    return sum;
  }

  const SampledMoments& method_;
  VisibilitySampler::Workspace workspace_;
};

SampledMoments::SampledMoments(const FormFactorContext& context)
    : PairMethod(context),
      moments_(this->context(), shapes()),
      visibility_(context.patches, context.rays, context.visibility_rays, context.seed) {}

std::unique_ptr<PairWork> SampledMoments::work() const { return std::make_unique<Work>(*this); }

}  // namespace interflect::fem

#include "fem/form_factor/sampled_moments.h"

#include "fem/form_factor/sampled_pair.h"
#include "fem/form_factor/seen_block.h"

namespace interflect::fem {

class SampledMoments::Work final : public PairWork {
 public:
  explicit Work(const SampledMoments& method) : method_(method) {}

  void clear(Index i, Index j, const PairIntegral& K, ExchangeSink& sink) override {
    method_.moments_.write(i, j, method_.moments_.of(i, j)(i, j, K), 0, sink);
  }
  void doubtful(const DoubtfulPair& pair, ExchangeSink& sink, PairCounts& counts) override {
    const double K_00 = pair.unoccluded.value;
    const SampledVisibility V = sampled(pair, method_.shapes(), method_.visibility_, workspace_, counts);
    const MomentIntegrator& moments = method_.moments_.of(pair.i, pair.j);
    const PairMoments block = seen_block(moments(pair.i, pair.j, pair.unoccluded), K_00, V, workspace_,
                                         moments.basis(pair.i), moments.basis(pair.j), method_.shapes().origin());
    method_.moments_.write(pair.i, pair.j, block, K_00 * V.standard_error, sink);
  }

 private:
  const SampledMoments& method_;
  VisibilitySampler::Workspace workspace_;
};

SampledMoments::SampledMoments(const FormFactorContext& context)
    : PairMethod(context),
      moments_(this->context(), shapes()),
      visibility_(context.patches, context.rays, context.visibility_rays, context.seed, context.visibility_error) {}

std::unique_ptr<PairWork> SampledMoments::work() const { return std::make_unique<Work>(*this); }

}  // namespace interflect::fem

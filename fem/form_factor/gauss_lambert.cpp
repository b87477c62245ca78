#include "fem/form_factor/gauss_lambert.h"

#include "fem/form_factor/sampled_pair.h"

namespace interflect::fem {

class GaussLambert::Rays final : public PairOcclusion {
 public:
  explicit Rays(const GaussLambert& method) : method_(method) {}

  ExchangeEntry operator()(const DoubtfulPair& pair, PairCounts& counts) override {
    const double value = pair.unoccluded.value;
    const SampledVisibility v = sampled(pair, method_.shapes(), method_.visibility_, workspace_, counts);
    return {value * v.visible, value * v.standard_error, v.visible * pair.unoccluded.error};
  }

 private:
  const GaussLambert& method_;
  VisibilitySampler::Workspace workspace_;
};

GaussLambert::GaussLambert(const FormFactorContext& context)
    : PairMethod(context),
      visibility_(context.patches, context.rays, context.visibility_rays, context.seed, context.visibility_error) {}

std::unique_ptr<PairWork> GaussLambert::work() const { return std::make_unique<Rays>(*this); }

}  // namespace interflect::fem

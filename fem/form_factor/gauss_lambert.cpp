#include "fem/form_factor/gauss_lambert.h"

#include <algorithm>

namespace interflect::fem {

class GaussLambert::Rays final : public PairOcclusion {
 public:
  explicit Rays(const GaussLambert& method) : method_(method) {}

  ExchangeEntry operator()(const DoubtfulPair& pair, PairCounts& counts) override {
    const ElementShapes& shapes = method_.shapes();
    const double value = pair.unoccluded.value;
    const Effort effort = effort_for(value / std::min(shapes[pair.i].area, shapes[pair.j].area));
    const SampledVisibility v = method_.visibility_(pair.i, pair.j, effort, workspace_);
    ++counts.sampled;
    counts.rays += static_cast<std::uint64_t>(v.rays);
    return {value * v.visible, value * v.standard_error, pair.unoccluded.error};
  }

 private:
  const GaussLambert& method_;
  VisibilitySampler::Workspace workspace_;
};

GaussLambert::GaussLambert(const FormFactorContext& context)
    : PairMethod(context), visibility_(context.patches, context.rays, context.visibility_rays, context.seed) {}

std::unique_ptr<PairWork> GaussLambert::work() const { return std::make_unique<Rays>(*this); }

}  // namespace interflect::fem

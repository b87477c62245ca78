#include "fem/form_factor/gauss_lambert.h"

namespace interflect::fem {

class GaussLambert::Rays final : public PairOcclusion {
 public:
  explicit Rays(const GaussLambert& method) : method_(method) {}

  ExchangeEntry operator()(const DoubtfulPair& pair, PairCounts& counts) override {
    const double value = pair.unoccluded.value;
    const SampledVisibility v = method_.visibility_(pair, method_.shapes(), workspace_, counts);
    return {value * v.visible, value * v.standard_error, v.visible * pair.unoccluded.error};
  }

 private:
  const GaussLambert& method_;
  VisibilitySampler::Workspace workspace_;
};

GaussLambert::GaussLambert(const FormFactorContext& context) : PairMethod(context), visibility_(context) {}

std::unique_ptr<PairWork> GaussLambert::work() const { return std::make_unique<Rays>(*this); }

}  // namespace interflect::fem

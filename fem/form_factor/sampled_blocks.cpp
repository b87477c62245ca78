#include "fem/form_factor/sampled_blocks.h"

#include "fem/form_factor/seen_block.h"

namespace interflect::fem {

class SampledBlocks::Work final : public PairWork {
 public:
  explicit Work(const SampledBlocks& method) : method_(method), stride_(plane_functions(method.context().order)) {}

  void clear(Index i, Index j, const PairIntegral& K, ExchangeSink& sink) override {
    write_block(i, j, stride_, method_.block(i, j, K), 0, sink);
  }
  void doubtful(const DoubtfulPair& pair, ExchangeSink& sink, PairCounts& counts) override {
    const SampledVisibility V = method_.visibility_(pair, method_.shapes(), workspace_, counts);
    const PairMoments unoccluded = method_.block(pair.i, pair.j, pair.unoccluded);
    const double K_00 = unoccluded.value(0, 0);
    const PairMoments seen = seen_block(unoccluded, K_00, V, workspace_, method_.basis(pair.i), method_.basis(pair.j),
                                        method_.shapes().origin());
    write_block(pair.i, pair.j, stride_, seen, K_00 * V.standard_error, sink);
  }

 private:
  const SampledBlocks& method_;
  Index stride_;
  VisibilitySampler::Workspace workspace_;
};

SampledBlocks::SampledBlocks(const FormFactorContext& context) : PairMethod(context), visibility_(context) {}

std::unique_ptr<PairWork> SampledBlocks::work() const { return std::make_unique<Work>(*this); }

}  // namespace interflect::fem

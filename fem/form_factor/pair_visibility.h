#pragma once

#include <algorithm>

#include "fem/form_factor/pair_method.h"
#include "fem/form_factor/visibility.h"

namespace interflect::fem {

/// V of pairs that something may hide, by as many rays as each is worth, which are counted.
class PairVisibility {
 public:
  explicit PairVisibility(const FormFactorContext& context)
      : sampler_(context.patches, context.rays, context.visibility_rays, context.seed, context.visibility_error) {}

  SampledVisibility operator()(const DoubtfulPair& pair, const ElementShapes& shapes,
                               VisibilitySampler::Workspace& workspace, PairCounts& counts) const {
    const double F = pair.unoccluded.value / std::min(shapes[pair.i].area, shapes[pair.j].area);
    const SampledVisibility v = sampler_(pair.i, pair.j, effort_for(F), workspace);
    ++counts.sampled;
    counts.rays += static_cast<std::uint64_t>(v.rays);
    return v;
  }

 private:
  VisibilitySampler sampler_;
};

}  // namespace interflect::fem

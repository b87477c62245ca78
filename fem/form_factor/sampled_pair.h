#pragma once

#include <algorithm>

#include "fem/form_factor/pair_method.h"
#include "fem/form_factor/visibility.h"

namespace interflect::fem {

/// V of a pair that something may hide, by as many rays as it is worth, which are counted.
inline SampledVisibility sampled(const DoubtfulPair& pair, const ElementShapes& shapes,
                                 const VisibilitySampler& sampler, VisibilitySampler::Workspace& workspace,
                                 PairCounts& counts) {
  const double F = pair.unoccluded.value / std::min(shapes[pair.i].area, shapes[pair.j].area);
  const SampledVisibility v = sampler(pair.i, pair.j, effort_for(F), workspace);
  ++counts.sampled;
  counts.rays += static_cast<std::uint64_t>(v.rays);
  return v;
}

}  // namespace interflect::fem

#include "fem/form_factor/exact_occlusion.h"

#include <algorithm>

namespace interflect::fem {

ExchangeEntry ExactOcclusion::operator()(const DoubtfulPair& pair, PairCounts& counts) {
  double hidden = 0, error = pair.unoccluded.error;
  const bool all = hidden_(
      pair, counts, [](const ElementShape& outer, bool) { return LambertOfParts{outer.plane.normal}; },
      [&](const HiddenIntegral& part, bool) { hidden += part.value, error += part.error; });
  if (all) return {};
  return {std::max(0.0, pair.unoccluded.value - hidden), 0, error};
}

}  // namespace interflect::fem

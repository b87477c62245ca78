#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

#include "fem/form_factor/method.h"

namespace interflect::fem {

/// min(A_a, A_b), above which no K_ab may be [m²].
inline double most_exchange(std::span<const scene::SurfacePatch> patches, Index a, Index b) {
  return std::min(patches[static_cast<std::size_t>(a)].area, patches[static_cast<std::size_t>(b)].area);
}

/// K from a count of n independent trials that succeed with probability K / whole:
///
///   K = whole h / n,   s² = whole² p' (1 - p') / n,   p' = (h + 1) / (n + 2)
///
/// The standard error is the binomial one with two trials added, one of each kind [Agresti, Coull 1998]: never 0, and
/// none that a hit more would surprise.  K above `most` is pulled back and counted; no error is larger than `most`,
/// since that is as far off as K may be.
/// @param whole, most  [m²]
inline ExchangeEntry counted_exchange(std::uint64_t hits, std::uint64_t trials, double whole, double most,
                                      PairCounts& counts) {
  const auto h = static_cast<double>(hits), n = static_cast<double>(trials);
  const double K = whole * h / n, p = (h + 1) / (n + 2), error = whole * std::sqrt(p * (1 - p) / n);
  counts.clamped += K > most;
  return {std::min(K, most), std::min(error, most), 0};
}

}  // namespace interflect::fem

#pragma once

#include "core/moments.h"

namespace interflect::montecarlo {

/// The samples of one measurement.  One that is not finite counts as zero and is remembered: it would be a bug, and the
/// key (index) lets it be traced again.
struct Tally {
  core::Moments moments;
  std::uint64_t not_finite = 0, first_not_finite = 0;  ///< how many, and the index of one of them

  void add(const Spectrum& sample, std::uint64_t index);
  void merge(const Tally& other);

  /// The unbiased estimate.  Where every sample of a channel scored zero although lights emit in it, the standard error
  /// is not 0 but the "rule of three": 3 w / n, the 95 % upper bound of a mean whose rare samples are of size w =
  /// `largest`. With samples that were not finite there is no bound on the error: infinite, and no claim.
  Estimate estimate(const Spectrum& largest) const;
};

}  // namespace interflect::montecarlo

#pragma once

#include <cstdint>

#include "core/estimate.h"
#include "core/spectrum.h"

namespace interflect::core {

/// Running mean and variance per channel, stable and mergeable.
///
/// Welford's update and the pairwise merge of [Chan, Golub, LeVeque 1983], equations (1.5): with d = mean_b - mean_a,
///   mean = mean_a + d n_b / n,   M2 = M2_a + M2_b + d² n_a n_b / n,   SE² = M2 / (n (n - 1)).
/// A sample is one whole independent random object, and one that scored zero counts.
class Moments {
 public:
  void add(const Spectrum& sample);
  void merge(const Moments& other);

  std::uint64_t count() const { return count_; }
  const Spectrum& mean() const { return mean_; }
  Spectrum variance() const;        ///< of one sample, unbiased; infinite below two samples
  Spectrum standard_error() const;  ///< of the mean; infinite below two samples
  Estimate unbiased() const { return unbiased_estimate(mean_, standard_error(), count_); }

 private:
  std::uint64_t count_ = 0;
  Spectrum mean_, squares_;  ///< squares_: sum of squared deviations from the mean (M2)
};

}  // namespace interflect::core

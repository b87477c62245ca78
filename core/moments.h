#pragma once

#include <cstdint>

#include "core/spectrum.h"

namespace interflect::core {

/// Running mean and variance of a number, or of a spectrum channel by channel; stable and mergeable.
///
/// Welford's update and the pairwise merge of [Chan, Golub, LeVeque 1983], equations (1.5): with d = mean_b - mean_a,
///   mean = mean_a + d n_b / n,   M2 = M2_a + M2_b + d² n_a n_b / n,   SE² = M2 / (n (n - 1)).
/// A sample is one whole independent random object, and one that scored zero counts.
template <class T>
class MomentsOf {
 public:
  MomentsOf() = default;
  /// As they were when count(), mean() and squared_deviations() told this.
  MomentsOf(std::uint64_t count, const T& mean, const T& squared_deviations)
      : count_(count), mean_(mean), squares_(squared_deviations) {}

  void add(const T& sample);
  void merge(const MomentsOf& other);

  std::uint64_t count() const { return count_; }
  const T& mean() const { return mean_; }
  const T& squared_deviations() const { return squares_; }  ///< M2
  T variance() const;                                       ///< of one sample, unbiased; infinite below two samples
  T standard_error() const;                                 ///< of the mean; infinite below two samples

 private:
  std::uint64_t count_ = 0;
  T mean_{}, squares_{};  ///< squares_: sum of squared deviations from the mean (M2)
};

using Moments = MomentsOf<Spectrum>;
using ScalarMoments = MomentsOf<double>;

extern template class MomentsOf<Spectrum>;
extern template class MomentsOf<double>;

}  // namespace interflect::core

#pragma once

#include "core/estimate.h"
#include "core/moments.h"
#include "scene/scene.h"

namespace interflect::montecarlo {

/// The samples of one measurement.  One that is not finite counts as zero and is remembered: it would be a bug, and the
/// key (index) lets it be traced again.
struct Tally {
  core::Moments moments;        ///< channel by channel
  core::ScalarMoments weighed;  ///< of the scene's weighted value: the channels of a path are correlated
  double largest_sample = 0;    ///< |weighed| of the largest sample
  double sum_of_sizes = 0;      ///< of |weighed|, since samples may have signs
  Spectrum without_light;       ///< how many samples found none in a channel
  std::uint64_t not_finite = 0, first_not_finite = 0;  ///< how many, and the index of one of them

  /// @param weighed_sample  the scene's weighted value of the sample
  /// @param light           what it found, where a sample is that less a control variate
  void add(const Spectrum& sample, double weighed_sample, std::uint64_t index, const Spectrum& light);
  void add(const Spectrum& sample, double weighed_sample, std::uint64_t index) {
    add(sample, weighed_sample, index, sample);
  }
  void merge(const Tally& other);

  /// Of all samples' sizes together, in the weighted value; 0 where that is nothing.
  double share_of_one() const;
  /// Whether no sample found light in any channel, whatever a control variate made of it.
  bool found_none() const;

  /// The unbiased estimate.  Where every sample of a channel found nothing although lights emit in it, the standard error
  /// is at least the "rule of three": 3 w / n, the 95 % upper bound of a mean whose rare samples are of size w =
  /// `largest`; that of the weighted value is then not known.  A control variate's own noise does not tell of those.
  /// With samples that were not finite there is no bound on the error: infinite, and no claim.
  Estimate estimate(const Spectrum& largest) const;
};

/// Of the scene's weighted value: as it was measured, else an upper bound by its channels'.
double weighed_standard_error(const scene::Scene& scene, const Estimate& estimate);

/// One line where samples were not finite, with the key of the first.
void warn_of_bugs(const Tally& tally, const char* who, std::size_t measurement, std::uint64_t seed);

}  // namespace interflect::montecarlo

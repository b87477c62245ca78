#pragma once

#include <vector>

#include "montecarlo/film/film_state.h"
#include "montecarlo/tally.h"

namespace interflect::montecarlo {

/// The samples of every pixel, each pixel's added one after the other by a single thread at a time.
///
/// Errors are those of independent samples, or of samples in batches, the k-th in batch k mod batches: whatever ties
/// those of one together, batches are independent, and the standard error is that of the mean of their means,
///
///   SE² = sum_b (mean_b - mean)² / (B (B - 1)),   B - 1 degrees of freedom.
class Film {
 public:
  /// @param batches  0: samples are independent; else at least 16
  Film(std::size_t pixels, int channels, int batches = 0);

  std::size_t pixels() const { return tallies_.size(); }
  /// The next sample of a pixel, with its weighed value.
  void add(std::size_t pixel, const Spectrum& sample, double weighed);
  std::uint64_t samples(std::size_t pixel) const { return tallies_[pixel].moments.count(); }
  std::uint64_t fewest_samples() const;
  std::uint64_t not_finite() const;
  const Tally& tally(std::size_t pixel) const { return tallies_[pixel]; }

  /// See Tally::estimate; of batches, `samples` counts them.  @pre  as many samples in each batch
  Estimate estimate(std::size_t pixel, const Spectrum& largest) const;

  FilmState state() const;
  Index state_columns() const;
  /// @throws core::InputError  for numbers that are no state of such a film
  void restore(const FilmState& state);

 private:
  struct Batch {
    Spectrum sum;
    double weighed = 0;
  };

  int channels_, batches_;
  std::vector<Tally> tallies_;
  std::vector<Batch> of_batches_;  ///< [pixel * batches + batch]
};

}  // namespace interflect::montecarlo

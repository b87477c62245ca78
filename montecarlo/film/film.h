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
///
/// Samples may say how much they left out at most: a bound on the error beside the noise.
class Film {
 public:
  /// @param batches     0: samples are independent; else at least 16
  /// @param leaves_out  whether samples do
  Film(std::size_t pixels, int channels, int batches = 0, bool leaves_out = false);

  std::size_t pixels() const { return tallies_.size(); }
  /// The next sample of a pixel, with its weighed value.
  void add(std::size_t pixel, const Spectrum& sample, double weighed) { add(pixel, sample, weighed, sample); }
  /// @param light  as of Tally::add
  void add(std::size_t pixel, const Spectrum& sample, double weighed, const Spectrum& light);
  /// Of a sample that was added.  @pre  samples do
  void leave_out(std::size_t pixel, const Spectrum& at_most) { left_out_[pixel] += at_most; }
  std::uint64_t samples(std::size_t pixel) const { return tallies_[pixel].moments.count(); }
  std::uint64_t fewest_samples() const;
  const Tally& tally(std::size_t pixel) const { return tallies_[pixel]; }

  /// See Tally::estimate; of batches, `samples` counts them.  The bound is the mean of what samples left out, a claim
  /// that is estimated.  @pre  as many samples in each batch
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

  Estimate noise_of(std::size_t pixel, const Spectrum& largest) const;

  int channels_, batches_;
  std::vector<Tally> tallies_;
  std::vector<Batch> of_batches_;   ///< [pixel * batches + batch]
  std::vector<Spectrum> left_out_;  ///< sums by pixel; empty where samples do not
};

}  // namespace interflect::montecarlo

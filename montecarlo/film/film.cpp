#include "montecarlo/film/film.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace interflect::montecarlo {
namespace {

/// Numbers one after the other in a row.
class RowWriter {
 public:
  RowWriter(FilmState& values, Index row) : values_(values), row_(row) {}
  void operator()(double x) { values_(row_, column_++) = x; }
  void operator()(std::uint64_t n) { operator()(static_cast<double>(n)); }  // exact to 2^53
  void operator()(const Spectrum& s, int channels) {
    for (int c = 0; c < channels; ++c) operator()(s[c]);
  }

 private:
  FilmState& values_;
  Index row_, column_ = 0;
};

class RowReader {
 public:
  RowReader(const FilmState& values, Index row) : values_(values), row_(row) {}
  double number() { return values_(row_, column_++); }
  std::uint64_t count() {
    const double x = number();
    if (!(x >= 0 && x <= 0x1p53 && x == std::floor(x))) throw core::InputError("film", "a count expected");
    return static_cast<std::uint64_t>(x);
  }
  Spectrum spectrum(int channels) {
    Spectrum s;
    for (int c = 0; c < channels; ++c) s[c] = number();
    return s;
  }

 private:
  const FilmState& values_;
  Index row_, column_ = 0;
};

}  // namespace

Film::Film(std::size_t pixels, int channels, int batches, bool leaves_out)
    : channels_(channels),
      batches_(batches),
      tallies_(pixels),
      of_batches_(pixels * static_cast<std::size_t>(batches)),
      left_out_(leaves_out ? pixels : 0) {
  if (batches != 0 && batches < 16) throw core::PreconditionError("film: at least 16 batches expected");
}

void Film::add(std::size_t pixel, const Spectrum& sample, double weighed, const Spectrum& light) {
  const std::uint64_t index = samples(pixel);
  tallies_[pixel].add(sample, weighed, index, light);
  if (batches_ == 0 || !sample.is_finite()) return;
  const auto all = static_cast<std::size_t>(batches_);
  Batch& batch = of_batches_[pixel * all + index % all];
  batch.sum += sample;
  batch.weighed += weighed;
}

std::uint64_t Film::fewest_samples() const {
  const auto fewer = [](const Tally& a, const Tally& b) { return a.moments.count() < b.moments.count(); };
  return std::min_element(tallies_.begin(), tallies_.end(), fewer)->moments.count();
}

Estimate Film::estimate(std::size_t pixel, const Spectrum& largest) const {
  Estimate found = noise_of(pixel, largest);
  if (left_out_.empty() || found.claim == Claim::none) return found;
  found.error_bound = left_out_[pixel] / static_cast<double>(samples(pixel));
  found.claim = Claim::estimated;
  return found;
}

Estimate Film::noise_of(std::size_t pixel, const Spectrum& largest) const {
  if (batches_ == 0) return tallies_[pixel].estimate(largest);
  Tally means = tallies_[pixel];
  means.moments = {};
  means.weighed = {};
  means.without_light = Spectrum::zero();
  const double in_batch = static_cast<double>(samples(pixel)) / batches_;
  for (int b = 0; b < batches_; ++b) {
    const Batch& batch = of_batches_[pixel * static_cast<std::size_t>(batches_) + static_cast<std::size_t>(b)];
    means.moments.add(batch.sum / in_batch);
    means.weighed.add(batch.weighed / in_batch);
  }
  // What all samples missed they would have hit as often as independent ones do: the rule of three is of their number.
  return means.estimate(largest / in_batch);
}

Index Film::state_columns() const {
  return 7 + 3 * channels_ + batches_ * (channels_ + 1) + (left_out_.empty() ? 0 : channels_);
}

FilmState Film::state() const {
  FilmState values(static_cast<Index>(pixels()), state_columns());
  for (std::size_t p = 0; p < pixels(); ++p) {
    RowWriter put(values, static_cast<Index>(p));
    const Tally& tally = tallies_[p];
    put(tally.moments.count());
    put(tally.moments.mean(), channels_);
    put(tally.moments.squared_deviations(), channels_);
    put(tally.weighed.mean());
    put(tally.weighed.squared_deviations());
    put(tally.largest_sample);
    put(tally.sum_of_sizes);
    put(tally.without_light, channels_);
    put(tally.not_finite);
    put(tally.first_not_finite);
    for (int b = 0; b < batches_; ++b) {
      const Batch& batch = of_batches_[p * static_cast<std::size_t>(batches_) + static_cast<std::size_t>(b)];
      put(batch.sum, channels_);
      put(batch.weighed);
    }
    if (!left_out_.empty()) put(left_out_[p], channels_);
  }
  return values;
}

void Film::restore(const FilmState& state) {
  if (state.rows() != static_cast<Index>(pixels()) || state.cols() != state_columns())
    throw core::InputError("film", "the state of another film");
  for (std::size_t p = 0; p < pixels(); ++p) {
    RowReader take(state, static_cast<Index>(p));
    Tally& tally = tallies_[p];
    const std::uint64_t n = take.count();
    if (batches_ > 0 && n % static_cast<std::uint64_t>(batches_) != 0)
      throw core::InputError("film", "batches of one size expected");
    const Spectrum mean = take.spectrum(channels_), squares = take.spectrum(channels_);
    tally.moments = {n, mean, squares};
    const double weighed = take.number();
    tally.weighed = {n, weighed, take.number()};
    tally.largest_sample = take.number();
    tally.sum_of_sizes = take.number();
    tally.without_light = take.spectrum(channels_);
    tally.not_finite = take.count();
    tally.first_not_finite = take.count();
    for (int b = 0; b < batches_; ++b) {
      Batch& batch = of_batches_[p * static_cast<std::size_t>(batches_) + static_cast<std::size_t>(b)];
      batch.sum = take.spectrum(channels_);
      batch.weighed = take.number();
    }
    if (!left_out_.empty()) left_out_[p] = take.spectrum(channels_);
  }
}

}  // namespace interflect::montecarlo

#pragma once

#include <vector>

#include "core/run.h"
#include "montecarlo/bidirectional/bidirectional_estimator.h"
#include "montecarlo/film/reconstruction_filter.h"
#include "scene/camera.h"

namespace interflect::montecarlo {

/// Pixels of a camera by bidirectional path tracing, sweep by sweep: in a sweep each pixel has a walk from the eye and
/// one from a light, which are joined, and every light's walk may leave something in every pixel.
///
/// A sample of a pixel is all that it gets in one sweep.  Sweeps are independent of each other, pixels are not: the
/// error of a sum of pixels is not told by theirs.
/// Walks are keyed by (seed, pixel, sweep): same bits for any number of threads, and however sweeps are cut into calls.
class BidirectionalFilm {
 public:
  /// @param pixels  y * width + x of those that are wanted, each once
  /// All must outlive it.
  BidirectionalFilm(const BidirectionalEstimator& walks, const scene::Camera& camera, std::vector<std::uint32_t> pixels,
                    const ReconstructionFilter& filter, std::uint64_t seed);

  std::size_t pixels() const { return pixels_.size(); }
  /// So many sweeps are worth a call.
  std::uint64_t sweeps_at_once() const;

  /// @return  the samples of sweeps first .. end - 1, pixel by pixel of each; empty if the run is stopped before
  std::vector<Spectrum> samples(std::uint64_t first, std::uint64_t end, Run& run) const;

 private:
  struct Deposit {
    std::uint32_t pixel;  ///< index into pixels_
    Spectrum value;
  };
  void sweep(std::uint64_t k, std::size_t begin, std::size_t end, std::span<Spectrum> samples,
             std::vector<Deposit>& deposits) const;
  void deposit(const BidirectionalEstimator::Splat& splat, std::vector<Deposit>& deposits) const;

  const BidirectionalEstimator& walks_;
  scene::FilmMap map_;
  int width_, height_;
  std::vector<std::uint32_t> pixels_;
  std::vector<std::uint32_t> index_of_;  ///< by pixel; `none` of those not wanted
  static constexpr std::uint32_t none = ~0u;
  const ReconstructionFilter& filter_;
  std::uint64_t seed_;
};

}  // namespace interflect::montecarlo

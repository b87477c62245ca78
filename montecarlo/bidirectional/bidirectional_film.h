#pragma once

#include <vector>

#include "montecarlo/bidirectional/bidirectional_estimator.h"
#include "montecarlo/film/reconstruction_filter.h"
#include "montecarlo/film/sweeps.h"
#include "scene/camera.h"

namespace interflect::montecarlo {

/// Pixels of a camera by bidirectional path tracing, sweep by sweep: in a sweep each pixel has a walk from the eye and
/// one from a light, which are joined, and every light's walk may leave something in every pixel.
///
/// Walks are keyed by (seed, pixel, sweep).
class BidirectionalFilm final : public Sweeps {
 public:
  /// @param pixels  y * width + x of those that are wanted, each once
  /// All must outlive it.
  BidirectionalFilm(const BidirectionalEstimator& walks, const scene::Camera& camera, std::vector<std::uint32_t> pixels,
                    const ReconstructionFilter& filter, std::uint64_t seed);

  std::size_t pixels() const override { return pixels_.size(); }

 private:
  void sweep(std::uint64_t k, std::size_t begin, std::size_t end, std::span<Spectrum> samples,
             Deposits& deposits) const override;
  void deposit(const BidirectionalEstimator::Splat& splat, Deposits& deposits) const;

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

#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "montecarlo/tally.h"

namespace interflect::montecarlo {

/// What there is to say of samples beside the estimates that they make: those that are no numbers, as where a density is
/// zero, and measurements of which one sample is so much that their standard errors may be far too small.
struct SampleReport {
  /// One sample is this share of what all samples of a measurement found.
  struct Heavy {
    std::size_t measurement;
    double share;
  };
  std::uint64_t not_finite = 0;
  std::vector<Heavy> heavy;

  void add(std::size_t measurement, const Tally& tally);
  /// Of measurements of[0], of[1], .. of a longer list.
  void add(const SampleReport& part, std::span<const std::size_t> of);
  /// "one sample carries 7 % of floor: its error may be understated; so in 3 of 20"; empty where none does.
  /// @param names  of all measurements
  std::string heavy_text(const std::vector<std::string>& names) const;
};

/// Above this share one sample is heavy; of n samples above 20 / n too, 20 times what a sample is on average, since of few
/// samples each is much.
inline constexpr double heavy_share = 0.05, heavy_over_mean = 20;

}  // namespace interflect::montecarlo

#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "montecarlo/tally.h"

namespace interflect::montecarlo {

/// What there is to say of samples beside the estimates that they make: those that are no numbers, as f / p is where
/// the density p is zero, and measurements of which one sample is so much that their standard errors may be far too small.
struct SampleReport {
  /// One sample is this share of what all samples of a measurement found.
  struct Heavy {
    std::size_t measurement;
    double share;
  };
  std::uint64_t not_finite = 0;
  std::vector<Heavy> heavy;
  std::string rare;  ///< of light that samples may not have met (RareLights::text); empty where there is none
  std::uint64_t rare_samples = 0;  ///< of the measurement that this is of, that which has the fewest
  std::size_t rare_measurement = 0;

  void add(std::size_t measurement, const Tally& tally);
  /// Of measurements of[0], of[1], .. of a longer list.
  void add(const SampleReport& part, std::span<const std::size_t> of);
  /// "one sample carries 7 % of floor: its error may be understated; so in 3 of 20"; empty where none does.
  /// @param names  of all measurements
  std::string heavy_text(const std::vector<std::string>& names) const;
  /// "floor: light of sun by way of mirrors ..": which measurement it is of, too; empty where nothing is rare.
  std::string rare_text(const std::vector<std::string>& names) const;
  /// Of a picture, whose measurements are its pixels: the share of those; empty where that is below `heavy_pixels`.
  std::string heavy_text_of_picture(int width, int height) const;

 private:
  const Heavy& worst() const;
};

/// One sample is heavy where it is more than 5 % of what all of them found, and there are at least 400.
///
/// Of n samples alike each is 1 / n, so that 5 % tell something only where n is well above 20.  Where one is 5 %, 20 such
/// make the whole: found 20 times or less, light may as well have been found half as often, and the standard error, made of
/// the same finds, would not know.  Whether it is rare light is seen where 20 finds are less than one sample in 20, n > 400;
/// of fewer samples it may be what every wall sends, met late, and the stated error, above 5 % itself, says so already.
inline constexpr double heavy_share = 0.05;
inline constexpr std::uint64_t heavy_fewest = 400;
/// Share of a picture's pixels from which on it is told: among many pixels a few have such a sample by chance.
inline constexpr double heavy_pixels = 0.01;

}  // namespace interflect::montecarlo

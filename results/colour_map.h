#pragma once

#include <array>
#include <cstdint>

namespace interflect::results {

using Colour = std::array<std::uint8_t, 3>;  ///< sRGB

/// From numbers to colours.  The first three grow evenly in lightness, so that they also read in grey and to the
/// colour-blind; the last is for differences: blue below, white at nothing, red above.
enum class ColourMap : std::uint8_t { plasma, viridis, inferno, blue_white_red };

/// Colour of t in [0, 1] (clamped), by linear interpolation between control points; grey for NaN.
/// Source of the points: S. van der Walt and N. Smith, matplotlib's maps of 2015 (public domain); K. Moreland 2009 for
/// the last.
Colour colour_of(ColourMap map, double t);

inline constexpr Colour no_data{190, 190, 190};

}  // namespace interflect::results

#pragma once

#include <array>

namespace interflect::scene {

/// Luminance of linear red, green and blue, in that of their white (sRGB, IEC 61966-2-1).
inline constexpr std::array<double, 3> srgb_luminance{0.2126, 0.7152, 0.0722};

}  // namespace interflect::scene

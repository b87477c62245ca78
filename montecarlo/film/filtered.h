#pragma once

#include "core/spectrum.h"
#include "montecarlo/film/reconstruction_filter.h"
#include "scene/camera.h"

namespace interflect::montecarlo {

/// Of a picture's pixel y * width + x, on the film [pixels].
inline Vec2 middle_of(const scene::Camera& camera, std::size_t pixel) {
  const auto width = static_cast<std::size_t>(camera.width);
  return {static_cast<double>(pixel % width) + 0.5, static_cast<double>(pixel / width) + 0.5};
}

/// What a filter makes of one point of the film, or of two where it has negative lobes (ReconstructionFilter).
/// @param u, v  in [0, 1)
/// @param seen  seen(point of the film, whether it is the second one)
template <class Seen>
Spectrum filtered(const ReconstructionFilter& filter, const Vec2& middle, double u, double v, const Seen& seen) {
  const double negative = filter.negative();
  const Spectrum found = seen(middle + filter.sample(u, v), false);
  if (negative == 0) return found;
  return (1 + negative) * found - negative * seen(middle + filter.sample_negative(u, v), true);
}

}  // namespace interflect::montecarlo

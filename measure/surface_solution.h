#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "scene/place.h"

namespace interflect::measure {

/// A radiosity solution as others see it, by place: what diffuse surfaces reflect, rho H = B - E [W/m² | lm/m²].
struct SurfaceSolution {
  /// What is known at a point; zeros where the solution knows nothing.
  struct Known {
    Spectrum reflected;
    Spectrum error_bound;      ///< estimated, on what is not noise
    Spectrum own_noise;        ///< standard error, of a deviation that a cell has for itself
    Spectrum shared_noise;     ///< and of one and the same deviation everywhere
    Spectrum mirrored;         ///< of `reflected` what lamps send by mirrors and glass first, A S+ D
    Spectrum mirrored_error;   ///< estimated, noise and all
    std::uint32_t cell = ~0u;  ///< of which that is known
  };
  std::function<const Known&(const scene::SurfacePoint&)> at;  ///< null: there is no solution

  double processor_seconds = 0;  ///< that it took
  std::string why_none;          ///< where there is none

  bool known() const { return static_cast<bool>(at); }
};

}  // namespace interflect::measure

#pragma once

#include <cstdint>
#include <string>

#include "core/spectrum.h"
#include "scene/place.h"

namespace interflect::scene {

enum class Sides : std::uint8_t { front, both };

/// A diffuse material.  A side that is not among `sides` is black: it absorbs what it receives.
struct Material {
  std::string name;
  Spectrum reflectance;  ///< rho, 0 <= rho < 1
  Spectrum exitance;     ///< E [W/m² | lm/m²], emitted by the front side only
  Sides sides = Sides::front;

  bool active(Side side) const { return side == Side::front || sides == Sides::both; }
  Spectrum reflectance_of(Side side) const { return active(side) ? reflectance : Spectrum::zero(); }
  Spectrum exitance_of(Side side) const { return side == Side::front ? exitance : Spectrum::zero(); }
};

}  // namespace interflect::scene

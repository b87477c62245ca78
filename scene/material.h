#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/spectrum.h"
#include "scene/finish.h"
#include "scene/place.h"

namespace interflect::scene {

enum class Sides : std::uint8_t { front, both };

inline constexpr double stefan_boltzmann = 5.670374419e-8;  ///< sigma [W/(m² K^4)], exact since 2019 to these digits

/// What a grey surface exchanges heat by: its reflectance is 1 - emissivity.
struct Thermal {
  double emissivity;                  ///< in (0, 1], of all wavelengths and directions together
  std::optional<double> temperature;  ///< [K]
  double heat_flux = 0;               ///< net, leaving [W/m²]; of meaning where there is no temperature
};

/// What a surface is made of.  A side that is not among `sides` is black: it absorbs what it receives.
struct Material {
  std::string name;
  Spectrum reflectance;  ///< diffuse, 0 <= rho < 1
  Spectrum exitance;     ///< E [W/m² | lm/m²], emitted by the front side only
  Sides sides = Sides::front;
  std::optional<Thermal> thermal = std::nullopt;
  Finish finish = Lambertian{};
  double opacity = 1;      ///< the part of the surface that is there; light passes straight through the rest
  std::string group = {};  ///< of lights that are dimmed together; empty: the material's name

  const std::string& light_group() const { return group.empty() ? name : group; }
  /// Diffuse reflection is all that it does with light.
  bool is_diffuse() const { return std::holds_alternative<Lambertian>(finish) && opacity == 1; }
  /// "a mirror", "of glass": for messages.
  std::string kind() const { return opacity < 1 ? "not all there (opacity)" : "of the type '" + type_of(finish) + "'"; }
  bool active(Side side) const { return side == Side::front || sides == Sides::both; }
  Spectrum reflectance_of(Side side) const { return active(side) ? reflectance : Spectrum::zero(); }
  Spectrum exitance_of(Side side) const { return side == Side::front ? exitance : Spectrum::zero(); }
};

}  // namespace interflect::scene

#pragma once

#include <optional>
#include <string>
#include <variant>

#include "core/spectrum.h"

/// How surfaces scatter light.  Parts are of power, refractive indices relative to air.
namespace interflect::scene {

/// Diffuse: by Material::reflectance alone.
struct Lambertian {};

/// Reflects this part at any angle.
struct Mirror {
  Spectrum reflectance;  ///< 0 .. 1
};

/// Reflects by small facets, sharply or not.
struct Metal {
  struct Index {
    Spectrum eta, k;
  };
  std::variant<Spectrum, Index> reflects;  ///< at normal incidence, 0 .. 1, or by its complex index
  double roughness = 0;                    ///< alpha of the facets' slopes, 0 .. 1; 0: a polished one
};

/// The boundary of a clear body, whose outside is the front; both sides are active.
struct Glass {
  double index = 1.5;
  double roughness = 0;  ///< as a metal's
};

/// A thin sheet of clear or tinted glass: light that passes goes straight on.
struct Pane {
  Spectrum transmittance;  ///< at normal incidence
  double index = 1.5;
};

/// A clear smooth coat over a diffuse base with Material::reflectance.
struct Plastic {
  double index = 1.5;
};

using Finish = std::variant<Lambertian, Mirror, Metal, Glass, Pane, Plastic>;

/// As scene files call it: "diffuse", "mirror", "metal", "dielectric", "glass" (a pane), "plastic".
std::string type_of(const Finish& finish);

/// What clear glass of this index transmits at most, absorbing nothing: (1 - r) / (1 + r).
double most_transmitted(double index);

}  // namespace interflect::scene

#pragma once

#include <string>
#include <vector>

#include "geometry/box.h"
#include "montecarlo/light/light_set.h"
#include "scene/scene.h"

namespace interflect::montecarlo {

/// What a person calls a lamp: a ball, a sun, or surfaces that share corners to the last bit, however they are cut.
struct Lamp {
  std::string name;
  geometry::Box box;  ///< none from afar
  double area;        ///< across the way from which most of it is seen, or in the mean of all, the larger [m²];
                      ///< from afar the solid angle [sr]
  double picked;      ///< probability that a walk from a light leaves it (EmissionPicker)
};

/// Lamps of one radiance, but for a factor of 2.
struct AlikeLamps {
  Spectrum pi_radiance{};  ///< pi L, of each at most
  Spectrum arriving{};     ///< irradiance that all may bring straight; infinite where nothing is known
  std::vector<Lamp> lamps{};
};

/// Surfaces and balls.  Of more than a hundred alike one that is as small as any, anywhere among them, stands for all.
/// @param lights  the scene's
std::vector<AlikeLamps> lamps_nearby(const scene::Scene& scene, const LightSet& lights);
/// Suns that have an angle, and what is at least half as bright as the brightest of an environment map.
std::vector<AlikeLamps> lamps_afar(const scene::Scene& scene, const LightSet& lights);

}  // namespace interflect::montecarlo

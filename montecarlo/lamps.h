#pragma once

#include <string>
#include <vector>

#include "geometry/box.h"
#include "montecarlo/light/light_set.h"
#include "scene/scene.h"

namespace interflect::montecarlo {

/// What a person calls a lamp: a ball, a sun, or surfaces that share corners, however they are cut.
struct Lamp {
  std::string name;
  geometry::Box box;  ///< none of a sun
  double area;        ///< that is seen, at most [m²]; of a sun pi times its squared sine
  double picked;      ///< probability that a walk from a light leaves it (EmissionPicker)
};

/// Lamps of one radiance, but for a factor of 2.
struct AlikeLamps {
  Spectrum pi_radiance{};  ///< pi L, of each at most
  Spectrum arriving{};     ///< irradiance that all may bring straight; infinite where nothing is known
  std::vector<Lamp> lamps{};
};

/// Surfaces and balls.  Of more than a thousand alike the least stands for all.
/// @param lights  the scene's
std::vector<AlikeLamps> lamps_nearby(const scene::Scene& scene, const LightSet& lights);
/// Those that have an angle.
std::vector<AlikeLamps> suns_with_angle(const scene::Scene& scene, const LightSet& lights);

}  // namespace interflect::montecarlo

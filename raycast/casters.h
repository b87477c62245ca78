#pragma once

#include "raycast/ray_caster.h"

/// The ray casters that there are; `make_ray_caster` picks one by name.
namespace interflect::raycast {

/// Embree 3, single precision about the scene's centre; offset 2^-18 of the scene's largest dimension.
std::unique_ptr<RayCaster> make_embree_caster(const scene::Scene& scene);

/// Every facet against every ray in double precision; offset 1e-10 of the scene's largest dimension.
std::unique_ptr<RayCaster> make_brute_caster(const scene::Scene& scene);

}  // namespace interflect::raycast

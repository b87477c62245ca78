#pragma once

#include <string>
#include <vector>

#include "core/run.h"
#include "raycast/ray_caster.h"

namespace interflect::raycast {

/// What one side of a surface sees of the scene: parts of its hemisphere, cosine-weighted, mean over its area.
struct Exposure {
  scene::SurfaceId surface;
  scene::Side side;
  double backs = 0;           ///< black backs: near 1 where the surface, or what surrounds it, is inside out
  double nothing = 0;         ///< openings
  double standard_error = 0;  ///< of `backs`, at most
};

/// For every active side, by `rays` cosine-distributed rays from random points of it.  It is how a flipped wall shows.
std::vector<Exposure> exposures(const scene::Scene& scene, const RayCaster& caster, int rays, Run& run);

}  // namespace interflect::raycast

#pragma once

#include <vector>

#include "measure/measurement.h"
#include "scene/scene.h"

namespace interflect::measure {

/// The facets of one side of a surface as patches: `Flux` through them over the area is the surface's mean irradiance.
std::vector<scene::SurfacePatch> patches_of(const scene::Scene& scene, scene::SurfaceId surface, scene::Side side);

}  // namespace interflect::measure

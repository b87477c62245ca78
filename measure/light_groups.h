#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace interflect::measure {

/// Lights that are dimmed together, each with a solution of its own: those whose materials have the group's name
/// (scene::Material::light_group), in the order of their first surfaces.  None of a scene that is dark.  Lights beside
/// surfaces (scene::Lights) belong to none: what solves by group refuses scenes that have them.
std::vector<std::string> light_groups(const scene::Scene& scene);

}  // namespace interflect::measure

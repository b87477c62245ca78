#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace interflect::measure {

/// Lights that are dimmed together, each with a solution of its own: those whose materials have the group's name
/// (scene::Material::light_group), in the order of their first surfaces.  None of a scene that is dark.  Lights beside
/// surfaces (scene::Lights) belong to none: what solves by group refuses scenes that have them.
std::vector<std::string> light_groups(const scene::Scene& scene);

/// The scene with one group's lights alone: surfaces of that light group, and lights beside surfaces of that name, the sky
/// being called `sky`.  What else shines is dark then, and balls stand in the way as before.  Light adds up: so do the
/// answers of all groups.
/// @throws core::InputError  where there is no such group, with those known
scene::Scene lit_by(scene::Scene scene, const std::string& group);

}  // namespace interflect::measure

#pragma once

#include "raycast/ray_caster.h"
#include "scene/scene.h"

namespace interflect::apps {

/// Warns of faces that lie on each other and face each other, such as the bottom of a box and the floor that it stands
/// on: what is covered sees the inside of what covers it, which nothing leaves, so that its rows do not add up to 1 and
/// what it sends counts as lost.  Thin plates, whose faces look away from each other, are none.
void warn_of_contacts(const scene::Scene& scene, const raycast::RayCaster& rays);

}  // namespace interflect::apps

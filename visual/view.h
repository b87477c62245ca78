#pragma once

#include "scene/scene.h"

namespace interflect::visual {

/// A camera outside a scene, from which all of it fills the picture: from the front, the right and above.  With the
/// polygons that turn their backs left out, one looks into a room.
scene::Camera outside_view(const scene::Scene& scene, int width, int height);

}  // namespace interflect::visual

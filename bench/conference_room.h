#pragma once

#include <optional>

#include "scene/scene.h"

namespace interflect::bench {

/// The conference room of the Lawrence Berkeley Laboratory, 331 179 triangles [McGuire's archive], with six lamps of our
/// own below its ceiling, since the model has none: unpacked by CMake from $INTERFLECT_CORPUS/conference, in centimetres.
/// Its first camera looks along the table.
/// @return  nothing where that folder is not, or cannot be unpacked
std::optional<scene::Scene> conference_room();

}  // namespace interflect::bench

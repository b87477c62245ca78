#pragma once

#include "scene/io/placement.h"

namespace interflect::scene::io {

/// @param scene  as far as it is read: its `up`, and how many cameras it has, are defaults
/// @throws core::InputError  in one line, with the place
Camera read_camera(const JsonNode& node, const LengthUnit& unit, const Scene& scene);

}  // namespace interflect::scene::io

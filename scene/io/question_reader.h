#pragma once

#include "scene/io/json_document.h"
#include "scene/io/placement.h"
#include "scene/scene.h"

namespace interflect::scene::io {

/// The keys "sensors", "cameras" and "expected": what is asked of a scene.
void read_sensors(const JsonNode& sensors, const LengthUnit& unit, Scene& scene);
void read_cameras(const JsonNode& cameras, const LengthUnit& unit, Scene& scene);
void read_expected(const JsonNode& expected, Scene& scene);  ///< after the sensors

}  // namespace interflect::scene::io

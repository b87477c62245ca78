#pragma once

#include <filesystem>

#include "scene/io/json_document.h"
#include "scene/io/placement.h"
#include "scene/reader.h"

namespace interflect::scene::io {

/// The key "lights": points, spots, spheres and suns.
void read_lights(const JsonNode& lights, const LengthUnit& unit, Scene& scene);

/// The key "sky": a uniform one, or a picture all around.
/// @param folder  that its file is relative to
void read_sky(const JsonNode& sky, const std::filesystem::path& folder, const PictureReader& read_picture,
              Scene& scene);

}  // namespace interflect::scene::io

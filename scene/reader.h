#pragma once

#include <filesystem>
#include <string_view>

#include "scene/scene.h"

namespace interflect::scene {

/// Reads and checks a scene file (docs/scene.md) with all that it refers to.
/// @throws core::InputError  "file:line: /json/pointer: what was expected", for anything that is not a scene
Scene read_scene(const std::filesystem::path& file);

/// The same from text; paths in it are relative to `folder`, and `name` stands for the file in messages.
Scene parse_scene(std::string_view text, const std::string& name, const std::filesystem::path& folder);

/// Adds warnings of what is odd in a scene that is read for its light: nothing emits, or a surface emits nothing whose
/// heat flux is known and whose temperature is not.
void warn_of_darkness(Scene& scene);

}  // namespace interflect::scene

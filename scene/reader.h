#pragma once

#include <filesystem>
#include <functional>
#include <string_view>

#include "core/image.h"
#include "scene/scene.h"

namespace interflect::scene {

/// The pixels of a picture file, .exr or .hdr, that a scene refers to; throws core::InputError.  Another room's affair:
/// results::read_radiance.
using PictureReader = std::function<core::Image(const std::filesystem::path&)>;

/// Reads and checks a scene file (docs/scene.md) with all that it refers to.
/// @param read_picture  nothing: a scene that refers to one is refused
/// @throws core::InputError  "file:line: /json/pointer: what was expected", for anything that is not a scene
Scene read_scene(const std::filesystem::path& file, const PictureReader& read_picture = {});

/// The same from text; paths in it are relative to `folder`, and `name` stands for the file in messages.
Scene parse_scene(std::string_view text, const std::string& name, const std::filesystem::path& folder,
                  const PictureReader& read_picture = {});

/// Adds warnings of what is odd in a scene that is read for its light: nothing emits, or a surface emits nothing whose
/// heat flux is known and whose temperature is not.
void warn_of_darkness(Scene& scene);

}  // namespace interflect::scene

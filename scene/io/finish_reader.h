#pragma once

#include "scene/io/json_document.h"
#include "scene/material.h"

namespace interflect::scene::io {

/// The key "type" of a material with what belongs to it, but for a diffuse part.
Finish read_finish(const JsonNode& material, int channels);

/// What a material of a type may say beside what all may.
std::vector<std::string> keys_of_type(const JsonNode& material);

}  // namespace interflect::scene::io

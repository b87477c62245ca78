#pragma once

#include <string>

#include "scene/scene.h"

namespace interflect::apps {

/// Before the work, of `--paths`.
/// @throws core::InputError  for what is no expression of paths, and for paths none of which the scene has: the answer
///                           would be black
void require_paths(const scene::Scene& scene, const std::string& expression);

}  // namespace interflect::apps

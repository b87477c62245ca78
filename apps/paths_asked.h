#pragma once

#include <string>

#include "measure/path_classes.h"
#include "scene/scene.h"

namespace interflect::apps {

/// Of `--paths`: those of an expression.
/// @throws core::InputError  for what is none, and where no light can take any of them in the scene: the answer would be
///                           black, after all the work
measure::PathClasses paths_asked(const scene::Scene& scene, const std::string& expression);

}  // namespace interflect::apps

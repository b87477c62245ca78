#pragma once

#include <filesystem>

#include "apps/options.h"
#include "apps/solved_scene.h"
#include "core/run.h"

namespace interflect::apps {

/// validation.png, validation_2.png, ..: for each camera of the scene, in its order, finite elements, path tracing and their
/// difference beside each other; with words over them where VTK was built in.  A stopped run ends without the pictures that it has
/// not begun.
void write_comparisons(const SolvedScene& solved, const ValidateOptions& options, Run& run);

}  // namespace interflect::apps

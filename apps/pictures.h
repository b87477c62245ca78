#pragma once

#include <array>
#include <string>

#include "apps/options.h"
#include "apps/solved_scene.h"
#include "core/run.h"
#include "results/comparison_panels.h"

namespace interflect::apps {

/// NAME.png of the first camera, NAME_2.png of the second: a camera's own name need not be one for a file.
std::string picture_file(const std::string& name, std::size_t camera);

/// The panels of two methods and their difference in one picture, with words over them where VTK was built in.
core::Image beside_each_other(const results::ComparisonPanels& panels, const std::array<std::string, 3>& titles,
                              double full_scale);

/// validation.png, validation_2.png, ..: for each camera of the scene, in its order, finite elements, path tracing and
/// their difference beside each other; with words over them where VTK was built in.  A stopped run ends without the
/// pictures that it has not begun.
void write_comparisons(const SolvedScene& solved, const ValidateOptions& options, Run& run);

}  // namespace interflect::apps

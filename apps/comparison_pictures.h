#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/first_pass.h"
#include "apps/options.h"
#include "core/run.h"
#include "scene/scene.h"

namespace interflect::apps {

/// Removes what an earlier comparison left in the folder, by its compare.json: pictures that this one does not write would
/// look like its own.  Those of other commands stay.
void remove_comparison_pictures(const std::filesystem::path& folder);

/// NAME.exr and NAME.png of each integrator, and what differs from the first beside both.  They grow sample by sample, as
/// those of `trace`: where the run is stopped, the one at work is written with the samples that it has, and those to come
/// are not.  Who refuses is told of in a warning.
/// @return  the names of the files
std::vector<std::string> write_comparison_pictures(const scene::Scene& scene, scene::CameraId camera,
                                                   const std::vector<std::string>& names, const FirstPass& first_pass,
                                                   const CompareOptions& options, Run& run);

}  // namespace interflect::apps

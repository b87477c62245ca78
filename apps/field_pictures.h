#pragma once

#include <filesystem>

#include "apps/smooth_field.h"
#include "apps/solved_scene.h"

namespace interflect::apps {

/// radiosity.png (as an eye would see it) and irradiance.png (false colour, legend in lx or W/m²) from the scene's
/// first pinhole camera, or from outside where it has none; where no display can be had, a warning and no pictures.
/// @param field  of polynomials: what is drawn in place of elements' means; null: none
void write_field_pictures(const SolvedScene& solved, const SmoothField* field, const std::filesystem::path& folder);

}  // namespace interflect::apps

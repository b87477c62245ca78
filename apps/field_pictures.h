#pragma once

#include <filesystem>
#include <string>

#include "apps/smooth_field.h"
#include "apps/solved_scene.h"

namespace interflect::apps {

/// What exposure and colours are made for.
struct PictureScale {
  std::vector<Spectrum> exitance, radiosity, irradiance;  ///< of elements
  std::string note;                                       ///< below each picture
};

/// The solution's own.  Where it has light groups their sum, which is the same but for the solver's tolerance or noise,
/// and to the bit what `dim` makes of them.
PictureScale scale_of(const fem::RadiositySolution& solution);

/// radiosity.png (as an eye would see it) and irradiance.png (false colour, legend in lx or W/m²) from the scene's
/// first pinhole camera, or from outside where it has none; where no display can be had, a warning and no pictures.
/// @param field  of polynomials: what is drawn in place of elements' means; null: none
void write_field_pictures(const SolvedScene& solved, const SmoothField* field, const std::filesystem::path& folder,
                          const PictureScale& scale);
inline void write_field_pictures(const SolvedScene& solved, const SmoothField* field,
                                 const std::filesystem::path& folder) {
  write_field_pictures(solved, field, folder, scale_of(solved.solution));
}

}  // namespace interflect::apps

#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "geometry/polygon.h"

namespace interflect::scene::io {

/// A surface of a View3D file.
struct View3dSurface {
  enum class Kind : std::uint8_t { radiating, mask, null, obstruction };
  Kind kind = Kind::radiating;
  int line = 0;
  geometry::Ring ring;            ///< 3 or 4 corners in the file's unit, counter-clockwise around the active side
  std::size_t base = 0;           ///< number, from 1, of the surface whose part it is; 0: of none
  std::size_t combined_with = 0;  ///< number of the surface that it is combined with; 0: none
  double emittance = 1;           ///< in [0, 1]; of an obstruction meaningless
  std::string name;
};

/// Reads View3D 3.x input (.vs3), formats F 3 and F 3a.  [View3D 3.3 User Manual, section 5]
///
/// Lines of T, C and X are passed over: titles and View3D's own settings.  Every base and every combination refers to a
/// surface that may be one.
/// @throws core::InputError  "FILE:LINE: .."
std::vector<View3dSurface> read_view3d(const std::filesystem::path& file, const std::string& shown);

}  // namespace interflect::scene::io

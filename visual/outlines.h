#pragma once

#include <cstdint>
#include <vector>

#include "results/colour_map.h"

namespace interflect::visual {

/// A picture by samples, several a pixel, row after row from above: their colours, and which face each sees.
struct Samples {
  static constexpr std::uint32_t back = 0;       ///< a back without elements
  static constexpr std::uint32_t nothing = ~0U;  ///< beside everything

  int width = 0, height = 0;
  std::vector<results::Colour> colours;
  std::vector<std::uint32_t> faces;  ///< or empty
  /// Clear bodies before all this: in each list at most one a sample, by a number from 1, or 0.
  std::vector<std::vector<std::uint8_t>> clear = {};

  std::size_t place(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
  bool holds(int x, int y) const { return x >= 0 && y >= 0 && x < width && y < height; }
  int clear_bodies(std::size_t place) const;  ///< one behind the other
};

/// Backs that are less than two samples wide become what is beside them.  Where a back ends at the edge of a front
/// whose corners lie elsewhere on that edge, rounding leaves such specks.
void leave_out_specks(Samples& samples);

/// Lines where a face or a clear body ends: dark on what is light, light on what is dark.  Faces of fewer than `enough`
/// samples have none: lines would be all that is seen of them.
/// @param reach     samples on each side of the border
/// @param of_faces  else of clear bodies alone, of which little else is seen
void draw_outlines(Samples& samples, int reach, int enough, bool of_faces = true);

}  // namespace interflect::visual

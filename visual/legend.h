#pragma once

#include <string>
#include <vector>

#include "core/image.h"
#include "results/colour_map.h"
#include "visual/scale.h"

namespace interflect::visual {

/// What the colours of a picture mean.  A logarithmic range is said to be one below the title.
struct Legend {
  std::string title;  ///< "irradiance [lx]"
  results::ColourMap map = results::ColourMap::plasma;
  Range range;
  bool open_above =
      false;  ///< values above the range exist: its end is labelled "500+", or "> 10" where both ends are open
  bool open_below = false;  ///< "< -10"; open ends are pointed
};

/// The picture with a white margin, a caption over it (if not empty) and a legend at its right; wide enough for the
/// caption.  The picture itself keeps its pixels; `left` and `top` say where it went, if asked.
core::Image framed(const core::Image& picture, const std::string& caption, const Legend* legend, int* left = nullptr,
                   int* top = nullptr);

/// A line below a picture, behind a square that is hatched (hatching.h) if that is what it tells of.
struct Note {
  std::string text;
  bool hatched = false;
};
/// The picture, its pixels where they were, with lines below it: wide enough for them.
core::Image noted(const core::Image& picture, const std::vector<Note>& notes);

}  // namespace interflect::visual

#pragma once

#include <string>

#include "core/image.h"
#include "results/colour_map.h"

namespace interflect::visual {

/// A line of text as coverage: one channel, [0, 1].
struct TextLine {
  int width = 0, height = 0;
  int ascent = 0;        ///< rows above the base line
  core::Image coverage;  ///< empty where there is nothing to draw

  bool empty() const { return width == 0; }
};

/// @param text  UTF-8
/// @param size  of the font [pixels]
TextLine set_in_type(const std::string& text, int size, bool bold = false);

/// Draws it on a picture of three channels, clipped at its border.
/// @param x     left of the line
/// @param base  row of the base line
void draw_text(core::Image& picture, const TextLine& line, int x, int base, results::Colour colour);

}  // namespace interflect::visual

#include "visual/legend.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "visual/hatching.h"
#include "visual/text.h"

namespace interflect::visual {

namespace {

constexpr results::Colour ink{45, 45, 45}, faint{150, 150, 150};

void fill(core::Image& picture, int left, int top, int width, int height, results::Colour colour) {
  for (int y = std::max(0, top); y < std::min(picture.height, top + height); ++y)
    for (int x = std::max(0, left); x < std::min(picture.width, left + width); ++x)
      for (int c = 0; c < 3; ++c)
        picture.at(x, y, c) = static_cast<float>(colour[static_cast<std::size_t>(c)]) / 255.0F;
}

/// Everything of a legend that has a size before it has a place.
struct Measured {
  struct Tick {
    double part;
    TextLine label;
  };
  TextLine title, spacing;  ///< the second empty where numbers are as far apart as they differ
  std::vector<Tick> ticks;
  int bar = 0, labels = 0;  ///< widths
  int width(int gap) const { return std::max({title.width, spacing.width, bar + gap + labels}); }
};

Measured measured(const Legend& legend, int size) {
  Measured m;
  m.title = set_in_type(legend.title, size);
  if (legend.range.logarithmic) m.spacing = set_in_type("logarithmic scale", size);
  m.bar = (size * 3) / 2;
  const std::vector<double> ticks = ticks_of(legend.range);
  const double step = ticks.size() > 1 ? ticks[1] - ticks[0] : legend.range.high - legend.range.low;
  const bool two_sided = legend.range.low < 0 && legend.open_below;
  for (double t : ticks) {
    std::string label = tick_label(t, legend.range.logarithmic ? t : step);
    constexpr double near = 1e-6;
    if (legend.open_above && legend.range.part(t) > 1 - near) label = two_sided ? "> " + label : label + "+";
    if (legend.open_below && legend.range.part(t) < near) label = "< " + label;
    m.ticks.push_back({legend.range.part(t), set_in_type(label, size)});
    m.labels = std::max(m.labels, m.ticks.back().label.width);
  }
  return m;
}

/// Of a bar that goes on: a triangle in the colour of its end.
/// @param end, away  the row beside the bar's last one, and the step from row to row
void draw_tip(core::Image& canvas, int left, int width, int end, int away, int tip, int line, results::Colour colour) {
  for (int k = 0; k <= tip; ++k) {
    const int part = (width * (tip - k)) / tip, at = left + (width - part) / 2, row = end + k * away;
    fill(canvas, at - line, row, part + 2 * line, 1, faint);
    fill(canvas, at, row, part, 1, colour);
  }
}

void draw_bar(core::Image& canvas, const Legend& legend, const Measured& m, int left, int top, int height, int size) {
  const int line = std::max(1, size / 16), tip = (2 * m.bar) / 3;
  if (legend.open_above) top += tip, height -= tip;
  if (legend.open_below) height -= tip;
  fill(canvas, left - line, top - line, m.bar + 2 * line, height + 2 * line, faint);
  for (int y = 0; y < height; ++y)
    fill(canvas, left, top + y, m.bar, 1, results::colour_of(legend.map, 1 - (y + 0.5) / height));
  if (legend.open_above) draw_tip(canvas, left, m.bar, top - 1, -1, tip, line, results::colour_of(legend.map, 1));
  if (legend.open_below) draw_tip(canvas, left, m.bar, top + height, 1, tip, line, results::colour_of(legend.map, 0));
  for (const Measured::Tick& tick : m.ticks) {
    const int y = top + static_cast<int>(std::lround((1 - tick.part) * (height - 1)));
    fill(canvas, left + m.bar, y - line / 2, size / 3, line, faint);
    draw_text(canvas, tick.label, left + m.bar + (2 * size) / 3, y + static_cast<int>(std::lround(0.36 * size)), ink);
  }
}

int size_of_type(const core::Image& picture) { return std::clamp(picture.height / 34, 13, 60); }

core::Image white_canvas(int width, int height) {
  core::Image canvas(width, height, {"R", "G", "B"});
  std::fill(canvas.data.begin(), canvas.data.end(), 1.0F);
  return canvas;
}

void paste(const core::Image& picture, core::Image& canvas, int left, int top) {
  for (int y = 0; y < picture.height; ++y)
    std::copy_n(picture.data.begin() + static_cast<std::ptrdiff_t>(picture.offset(0, y)),
                picture.offset(picture.width, 0),
                canvas.data.begin() + static_cast<std::ptrdiff_t>(canvas.offset(left, top + y)));
}

void draw_hatched(core::Image& canvas, int left, int top, int width, int height) {
  const int rim = std::max(1, height / 16);
  fill(canvas, left - rim, top - rim, width + 2 * rim, height + 2 * rim, faint);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      fill(canvas, left + x, top + y, 1, 1,
           hatching::on_stripe(x, y, std::max(4, height / 3)) ? hatching::stripe : hatching::ground);
}

}  // namespace

core::Image framed(const core::Image& picture, const std::string& caption, const Legend* legend, int* left, int* top) {
  const int size = size_of_type(picture), margin = size;
  const TextLine title = set_in_type(caption, size + size / 6, true);
  const int head = title.empty() ? margin : margin + 2 * size;
  const Measured m = legend != nullptr ? measured(*legend, size) : Measured{};
  const int gap = (2 * size) / 3;
  const int strip = legend != nullptr ? margin + m.width(gap) : 0;

  const int width = margin + std::max(picture.width + strip, title.width) + margin;
  core::Image canvas = white_canvas(width, head + picture.height + margin);
  paste(picture, canvas, margin, head);
  draw_text(canvas, title, margin, margin + size + size / 8, ink);
  if (legend != nullptr) {
    const int x = margin + picture.width + margin;
    const int second = m.spacing.empty() || m.title.empty() ? 0 : (5 * size) / 4;  // line, below the first
    const int bar_top = head + (m.title.empty() && m.spacing.empty() ? size / 2 : (9 * size) / 4 + second);
    draw_text(canvas, m.title, x, head + size, ink);
    draw_text(canvas, m.spacing, x, head + size + second, ink);
    draw_bar(canvas, *legend, m, x, bar_top, head + picture.height - bar_top - size / 2, size);
  }
  if (left != nullptr) *left = margin;
  if (top != nullptr) *top = head;
  return canvas;
}

core::Image noted(const core::Image& picture, const std::vector<Note>& notes) {
  if (notes.empty()) return picture;
  const int size = size_of_type(picture), gap = size / 2, square = 2 * size, row = 2 * size;
  std::vector<TextLine> lines;
  int width = picture.width;
  for (const Note& note : notes) {
    lines.push_back(set_in_type(note.text, size));
    width = std::max(width, lines.back().width + (note.hatched ? square + gap : 0) + 3 * gap);
  }
  core::Image canvas = white_canvas(width, picture.height + row * static_cast<int>(notes.size()));
  paste(picture, canvas, 0, 0);
  for (std::size_t k = 0; k < notes.size(); ++k) {
    const int top = picture.height + gap + row * static_cast<int>(k);
    if (notes[k].hatched) draw_hatched(canvas, gap, top, square, size);
    draw_text(canvas, lines[k], notes[k].hatched ? gap + square + gap : gap, top + size - size / 8, ink);
  }
  return canvas;
}

}  // namespace interflect::visual

#include "visual/plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/format.h"
#include "core/vec.h"
#include "results/colour_map.h"
#include "visual/canvas.h"
#include "visual/scale.h"

namespace interflect::visual {

namespace {

using results::Colour;

constexpr int width = 1040, height = 620, left = 90, right = 370, top = 50, bottom = 60;  // pixels of a panel
constexpr Colour grey{225, 225, 225}, faint{242, 242, 242};
/// Colours that differ in lightness as well as in hue.
constexpr std::array<Colour, 11> palette{Colour{31, 119, 180}, {214, 39, 40}, {44, 160, 44},   {148, 103, 189},
                                         {255, 127, 14},       {25, 25, 25},  {227, 119, 194}, {140, 86, 75},
                                         {23, 190, 207},       {150, 150, 0}, {127, 127, 127}};

bool drawable(double x, double y) { return x > 0 && y > 0 && std::isfinite(x) && std::isfinite(y); }

using Curves = std::vector<const Plot::Curve*>;

/// Whole decades, or of few of them 1, 2 and 5 times such.
Range axis_of(const Curves& curves, std::vector<double> Plot::Curve::*of) {
  double low = std::numeric_limits<double>::infinity(), high = 0;
  for (const Plot::Curve* curve : curves)
    for (std::size_t k = 0; k < curve->x.size(); ++k)
      if (drawable(curve->x[k], curve->y[k]))
        low = std::min(low, (curve->*of)[k]), high = std::max(high, (curve->*of)[k]);
  if (!(high > 0)) return {0.1, 1, true};
  constexpr double few = 3;  // decades
  if (std::log10(high / low) < few) return rounded_outwards(low, high);
  return {std::pow(10.0, std::floor(std::log10(low))), std::pow(10.0, std::ceil(std::log10(high))), true};
}

/// Columns and rows of a panel that begins at the row `above`.
struct Frame {
  Range x, y;
  int above = 0;
  double column(double value) const { return left + (width - left - right) * x.part(value); }
  double row(double value) const { return above + height - bottom - (height - top - bottom) * y.part(value); }
};

bool is_a_decade(double value) { return std::abs(std::log10(value) - std::round(std::log10(value))) < 1e-6; }

void draw_axes(Canvas& canvas, const Frame& frame) {
  const int below = frame.above + height - bottom;
  for (const double v : ticks_of(frame.x)) {
    const double x = frame.column(v);
    canvas.line({{x, double(frame.above + top)}, {x, double(below)}}, 0.3, is_a_decade(v) ? grey : faint);
    canvas.text(core::format("%g", v), static_cast<int>(x), below + 20, 13, Canvas::centred);
  }
  for (const double v : ticks_of(frame.y)) {
    const double y = frame.row(v);
    canvas.line({{left, y}, {width - right, y}}, 0.3, is_a_decade(v) ? grey : faint);
    canvas.text(core::format("%g", v), left - 8, static_cast<int>(y) + 5, 13, Canvas::to_the_left);
  }
}

void draw_words(Canvas& canvas, const Frame& frame, const Plot& plot, const std::string& panel) {
  canvas.text(plot.title + (panel.empty() ? "" : ": " + panel), left, frame.above + 24, 16, Canvas::bold);
  canvas.text(plot.y_label, left, frame.above + top - 8, 13);
  canvas.text(plot.x_label, (left + width - right) / 2, frame.above + height - 14, 13, Canvas::centred);
}

/// Five shapes, full and hollow by turns: with eleven colours 110 curves differ.
void draw_marker(Canvas& canvas, double x, double y, std::size_t curve) {
  const Colour colour = palette[curve % palette.size()];
  constexpr double turn = 0.5 * pi;
  const double size = 5;
  const bool hollow = curve % 2 == 1;
  switch (curve % 5) {
    case 0:
      return canvas.polygon(x, y, 24, 0.9 * size, 0, hollow, colour);  // a disk
    case 1:
      return canvas.polygon(x, y, 4, 1.2 * size, 0.5 * turn, hollow, colour);
    case 2:
      return canvas.polygon(x, y, 3, 1.3 * size, turn, hollow, colour);
    case 3:
      return canvas.polygon(x, y, 4, 1.3 * size, 0, hollow, colour);
    default:
      return canvas.polygon(x, y, 3, 1.3 * size, -turn, hollow, colour);
  }
}

std::vector<Canvas::Point> points_of(const Plot::Curve& curve, const Frame& frame) {
  std::vector<Canvas::Point> points;
  for (std::size_t k = 0; k < curve.x.size(); ++k)
    if (drawable(curve.x[k], curve.y[k])) points.push_back({frame.column(curve.x[k]), frame.row(curve.y[k])});
  return points;
}

/// At all of few points; else at the last, and at those that are far enough from the last that was marked.  Curves that
/// lie on each other begin at different distances, so that both show.
void draw_markers(Canvas& canvas, const std::vector<Canvas::Point>& points, std::size_t curve) {
  constexpr std::size_t few = 12;
  constexpr double apart = 26;  // pixels
  double to_go = apart * static_cast<double>(curve % 3) / 3;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (k > 0) to_go -= std::hypot(points[k].x - points[k - 1].x, points[k].y - points[k - 1].y);
    if (to_go > 0 && k + 1 < points.size() && points.size() > few) continue;
    draw_marker(canvas, points[k].x, points[k].y, curve);
    to_go = apart;
  }
}

/// The first x at which a curve is at or below y, between its points by a power law; infinite if it never is.
double reaches(const Plot::Curve& curve, double y) {
  double from_x = 0, from_y = 0;
  for (std::size_t k = 0; k < curve.x.size(); ++k) {
    if (!drawable(curve.x[k], curve.y[k])) continue;
    if (curve.y[k] <= y) {
      if (from_x == 0) return curve.x[k];
      return from_x * std::pow(curve.x[k] / from_x, std::log(y / from_y) / std::log(curve.y[k] / from_y));
    }
    from_x = curve.x[k], from_y = curve.y[k];
  }
  return std::numeric_limits<double>::infinity();
}

/// The least y that all curves reach, rounded up.
double reached_by_all(const Curves& curves) {
  double level = 0;
  for (const Plot::Curve* curve : curves) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < curve->x.size(); ++k)
      if (drawable(curve->x[k], curve->y[k])) least = std::min(least, curve->y[k]);
    if (std::isfinite(least)) level = std::max(level, least);
  }
  return round_up(level);
}

void draw_names(Canvas& canvas, const Frame& frame, const std::string& x_label, const Curves& curves,
                std::span<const std::size_t> numbers) {
  const double level = reached_by_all(curves);
  std::vector<std::size_t> order(curves.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return reaches(*curves[a], level) < reaches(*curves[b], level);
  });
  const int line = curves.size() <= 22 ? 22 : std::max(12, (height - top - 20) / static_cast<int>(curves.size()));
  int base = frame.above + top + 8;
  canvas.text(core::format("%s to %.2g", x_label.c_str(), level), width - 14, base, 13, Canvas::to_the_left);
  for (const std::size_t k : order) {
    base += line;
    draw_marker(canvas, width - right + 20, base - 5, numbers[k]);
    canvas.text(curves[k]->name, width - right + 34, base, 14);
    const double x = reaches(*curves[k], level);
    if (std::isfinite(x)) canvas.text(core::format("%.2g", x), width - 14, base, 14, Canvas::to_the_left);
  }
}

/// @param panel  its name; all curves where there is none
void draw_panel(Canvas& canvas, int above, const Plot& plot, const std::string* panel) {
  Curves curves;
  std::vector<std::size_t> numbers;  // in the plot: a curve's look does not depend on panels
  for (std::size_t k = 0; k < plot.curves.size(); ++k)
    if (panel == nullptr || plot.curves[k].panel == *panel) curves.push_back(&plot.curves[k]), numbers.push_back(k);
  const Frame frame{axis_of(curves, &Plot::Curve::x), axis_of(curves, &Plot::Curve::y), above};
  draw_axes(canvas, frame);
  draw_words(canvas, frame, plot, panel != nullptr ? *panel : "");
  for (std::size_t k = 0; k < curves.size(); ++k)
    canvas.line(points_of(*curves[k], frame), 0.8, palette[numbers[k] % palette.size()]);
  for (std::size_t k = 0; k < curves.size(); ++k) draw_markers(canvas, points_of(*curves[k], frame), numbers[k]);
  if (!curves.empty()) draw_names(canvas, frame, plot.x_label, curves, numbers);
}

}  // namespace

core::Image plot_picture(const Plot& plot) {
  constexpr std::size_t many = 9;
  std::vector<std::string> panels;
  for (const Plot::Curve& curve : plot.curves)
    if (std::find(panels.begin(), panels.end(), curve.panel) == panels.end()) panels.push_back(curve.panel);
  const bool in_one = plot.curves.size() < many;
  const int count = in_one ? 1 : static_cast<int>(panels.size());
  Canvas canvas(width, height * count);
  for (int k = 0; k < count; ++k)
    draw_panel(canvas, height * k, plot, in_one ? nullptr : &panels[static_cast<std::size_t>(k)]);
  return canvas.take();
}

}  // namespace interflect::visual

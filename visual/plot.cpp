#include "visual/plot.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/format.h"
#include "results/colour_map.h"
#include "visual/text.h"

namespace interflect::visual {

namespace {

using results::Colour;

constexpr int width = 970, height = 620, left = 90, right = 300, top = 50, bottom = 60;  // pixels
constexpr Colour black{0, 0, 0}, grey{225, 225, 225};
/// Twelve colours that differ in lightness as well as in hue: an even number, so that two curves of one
/// colour have different markers.
constexpr std::array<Colour, 12> palette{Colour{31, 119, 180}, {214, 39, 40},  {44, 160, 44}, {148, 103, 189},
                                         {255, 127, 14},       {23, 190, 207}, {140, 86, 75}, {227, 119, 194},
                                         {127, 127, 127},      {188, 189, 34}, {25, 25, 25},  {130, 170, 255}};

/// Whole decades that hold all points.
struct Axis {
  int first = 0, last = 1;
  double at(double value) const { return (std::log10(value) - first) / (last - first); }
};

bool drawable(double x, double y) { return x > 0 && y > 0 && std::isfinite(x) && std::isfinite(y); }

template <class Of>
Axis axis_of(const Plot& plot, const Of& of) {
  double low = 1e300, high = 0;
  for (const Plot::Curve& curve : plot.curves)
    for (std::size_t k = 0; k < curve.x.size(); ++k)
      if (drawable(curve.x[k], curve.y[k])) low = std::min(low, of(curve, k)), high = std::max(high, of(curve, k));
  if (!(high > 0)) return {};
  Axis axis{static_cast<int>(std::floor(std::log10(low))), static_cast<int>(std::ceil(std::log10(high)))};
  if (axis.last == axis.first) ++axis.last;
  return axis;
}

class Canvas {
 public:
  Canvas() : image_(width, height, {"R", "G", "B"}) { std::fill(image_.data.begin(), image_.data.end(), 1.0F); }

  /// A disk of this radius, its rim softened.
  void dot(double x, double y, double radius, Colour colour) {
    for (int j = static_cast<int>(y - radius) - 1; j <= static_cast<int>(y + radius) + 1; ++j)
      for (int i = static_cast<int>(x - radius) - 1; i <= static_cast<int>(x + radius) + 1; ++i)
        cover(i, j, std::clamp(radius + 0.5 - std::hypot(i - x, j - y), 0.0, 1.0), colour);
  }
  void ring(double x, double y, double radius, double half_width, Colour colour) {
    const double reach = radius + half_width;
    for (int j = static_cast<int>(y - reach); j <= static_cast<int>(y + reach) + 1; ++j)
      for (int i = static_cast<int>(x - reach); i <= static_cast<int>(x + reach) + 1; ++i)
        cover(i, j, std::clamp(half_width + 0.5 - std::abs(std::hypot(i - x, j - y) - radius), 0.0, 1.0), colour);
  }
  void line(double x0, double y0, double x1, double y1, double radius, Colour colour) {
    const int steps = 1 + static_cast<int>(2 * std::hypot(x1 - x0, y1 - y0));
    for (int k = 0; k <= steps; ++k) dot(x0 + (x1 - x0) * k / steps, y0 + (y1 - y0) * k / steps, radius, colour);
  }
  void text(const std::string& text, int x, int base, int size, bool centred = false, bool bold = false) {
    const TextLine set = set_in_type(text, size, bold);
    draw_text(image_, set, centred ? x - set.width / 2 : x, base, black);
  }
  core::Image take() { return std::move(image_); }

 private:
  /// The darker of what is there and what comes, so that steps of one line do not add up.
  void cover(int x, int y, double part, Colour colour) {
    if (part <= 0 || x < 0 || y < 0 || x >= width || y >= height) return;
    for (int c = 0; c < 3; ++c) {
      float& pixel = image_.at(x, y, c);
      const double inked = 1 - part * (1 - colour[static_cast<std::size_t>(c)] / 255.0);
      pixel = std::min(pixel, static_cast<float>(inked));
    }
  }
  core::Image image_;
};

struct Frame {
  Axis x, y;
  double column(double value) const { return left + (width - left - right) * x.at(value); }
  double row(double value) const { return height - bottom - (height - top - bottom) * y.at(value); }
};

std::string decade(int exponent) { return core::format("%g", std::pow(10.0, exponent)); }

void draw_axes(Canvas& canvas, const Frame& frame, const Plot& plot) {
  for (int e = frame.x.first; e <= frame.x.last; ++e) {
    const double x = frame.column(std::pow(10.0, e));
    canvas.line(x, top, x, height - bottom, 0.3, grey);
    canvas.text(decade(e), static_cast<int>(x), height - bottom + 20, 13, true);
  }
  for (int e = frame.y.first; e <= frame.y.last; ++e) {
    const double y = frame.row(std::pow(10.0, e));
    canvas.line(left, y, width - right, y, 0.3, grey);
    canvas.text(decade(e), left - 50, static_cast<int>(y) + 5, 13);
  }
  canvas.text(plot.title, left, 24, 16, false, true);
  canvas.text(plot.y_label, left, top - 8, 13);
  canvas.text(plot.x_label, (left + width - right) / 2, height - 14, 13, true);
}

/// Dots and rings by turns: neighbours of a list may lie on each other, and both show then.  Curves that have one
/// colour have different ones.
void draw_marker(Canvas& canvas, double x, double y, std::size_t curve, Colour colour) {
  if ((curve + curve / palette.size()) % 2 == 0)
    canvas.dot(x, y, 4, colour);
  else
    canvas.ring(x, y, 6, 1, colour);
}

void draw_curve(Canvas& canvas, const Frame& frame, const Plot& plot, std::size_t which, Colour colour) {
  const Plot::Curve& curve = plot.curves[which];
  constexpr double apart = 14;  // pixels between markers: of many points they would make a band
  bool started = false;
  double from_x = 0, from_y = 0, marked_x = 0, marked_y = 0;
  for (std::size_t k = 0; k < curve.x.size(); ++k) {
    if (!drawable(curve.x[k], curve.y[k])) continue;
    const double x = frame.column(curve.x[k]), y = frame.row(curve.y[k]);
    if (started) canvas.line(from_x, from_y, x, y, 0.8, colour);
    if (!started || std::hypot(x - marked_x, y - marked_y) >= apart) {
      draw_marker(canvas, x, y, which, colour);
      marked_x = x, marked_y = y;
    }
    from_x = x, from_y = y, started = true;
  }
}

}  // namespace

core::Image plot_picture(const Plot& plot) {
  const Frame frame{axis_of(plot, [](const Plot::Curve& c, std::size_t k) { return c.x[k]; }),
                    axis_of(plot, [](const Plot::Curve& c, std::size_t k) { return c.y[k]; })};
  Canvas canvas;
  draw_axes(canvas, frame, plot);
  for (std::size_t k = 0; k < plot.curves.size(); ++k) {
    const Colour colour = palette[k % palette.size()];
    draw_curve(canvas, frame, plot, k, colour);
    const int base = top + 20 + 22 * static_cast<int>(k);
    draw_marker(canvas, width - right + 20, base - 5, k, colour);
    canvas.text(plot.curves[k].name, width - right + 34, base, 14);
  }
  return canvas.take();
}

}  // namespace interflect::visual

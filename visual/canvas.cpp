#include "visual/canvas.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/vec.h"
#include "visual/text.h"

namespace interflect::visual {

namespace {

double distance_to_segment(double x, double y, const Canvas::Point& a, const Canvas::Point& b) {
  const double dx = b.x - a.x, dy = b.y - a.y, square = dx * dx + dy * dy;
  const double t = square > 0 ? std::clamp(((x - a.x) * dx + (y - a.y) * dy) / square, 0.0, 1.0) : 0;
  return std::hypot(x - a.x - t * dx, y - a.y - t * dy);
}

/// Part of a pixel that is within `reach` of what is `distance` away.
double covered(double distance, double reach) { return std::clamp(reach + 0.5 - distance, 0.0, 1.0); }

}  // namespace

Canvas::Canvas(int width, int height) : image_(width, height, {"R", "G", "B"}) {
  std::fill(image_.data.begin(), image_.data.end(), 1.0F);
}

void Canvas::cover(int x, int y, double part, results::Colour colour) {
  if (part <= 0 || x < 0 || y < 0 || x >= image_.width || y >= image_.height) return;
  for (int c = 0; c < 3; ++c) {
    float& pixel = image_.at(x, y, c);
    pixel += static_cast<float>(part * (colour[static_cast<std::size_t>(c)] / 255.0 - pixel));
  }
}

void Canvas::line(const std::vector<Point>& points, double radius, results::Colour colour) {
  std::map<std::pair<int, int>, double> parts;  // pixels of pieces that meet are covered once
  const double reach = radius + 1;
  for (std::size_t k = 0; k + 1 < points.size(); ++k) {
    const Point &a = points[k], &b = points[k + 1];
    for (int y = static_cast<int>(std::min(a.y, b.y) - reach); y <= std::max(a.y, b.y) + reach; ++y)
      for (int x = static_cast<int>(std::min(a.x, b.x) - reach); x <= std::max(a.x, b.x) + reach; ++x) {
        const double part = covered(distance_to_segment(x, y, a, b), radius);
        if (part > 0) parts[{x, y}] = std::max(parts[{x, y}], part);
      }
  }
  for (const auto& [at, part] : parts) cover(at.first, at.second, part, colour);
}

void Canvas::polygon(double x, double y, int corners, double radius, double turned, bool hollow,
                     results::Colour colour) {
  const double inner = radius * std::cos(pi / corners);
  for (int j = static_cast<int>(y - radius) - 1; j <= y + radius + 1; ++j)
    for (int i = static_cast<int>(x - radius) - 1; i <= x + radius + 1; ++i) {
      double outside = -inner;  // how far beyond the nearest side, less than 0 inside
      for (int k = 0; k < corners; ++k) {
        const double angle = turned + (2 * k + 1) * pi / corners;
        outside = std::max(outside, (i - x) * std::cos(angle) - (j - y) * std::sin(angle) - inner);
      }
      cover(i, j, covered(outside, 0) - (hollow ? covered(outside, -1.6) : 0), colour);
    }
}

void Canvas::text(const std::string& text, int x, int base, int size, unsigned setting) {
  const TextLine set = set_in_type(text, size, (setting & bold) != 0);
  const int start = setting & centred ? x - set.width / 2 : setting & to_the_left ? x - set.width : x;
  draw_text(image_, set, start, base, {0, 0, 0});
}

}  // namespace interflect::visual

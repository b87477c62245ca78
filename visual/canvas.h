#pragma once

#include <string>
#include <vector>

#include "core/image.h"
#include "results/colour_map.h"

namespace interflect::visual {

/// A white picture to draw lines, markers and words on, with soft rims.
class Canvas {
 public:
  struct Point {
    double x, y;
  };
  enum Setting : unsigned { plain = 0, bold = 1, centred = 2, to_the_left = 4 };  ///< of words; the last ends at x

  Canvas(int width, int height);

  /// From point to point, 2 `radius` + 1 pixels wide.
  void line(const std::vector<Point>& points, double radius, results::Colour colour);
  /// Regular; what is below a hollow one shows.
  /// @param radius   of its corners [pixels]
  /// @param turned   direction of the first corner [radians]
  void polygon(double x, double y, int corners, double radius, double turned, bool hollow, results::Colour colour);
  void text(const std::string& text, int x, int base, int size, unsigned setting = plain);

  core::Image take() { return std::move(image_); }

 private:
  void cover(int x, int y, double part, results::Colour colour);
  core::Image image_;
};

}  // namespace interflect::visual

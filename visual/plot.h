#pragma once

#include <string>
#include <vector>

#include "core/image.h"

namespace interflect::visual {

/// Curves of positive numbers against positive numbers, on logarithmic axes.
struct Plot {
  struct Curve {
    std::string name;
    std::vector<double> x, y;
  };
  std::string title, x_label, y_label;
  std::vector<Curve> curves;
};

/// 900 x 620 pixels, sRGB in [0, 1]: a frame with its decades, a line a curve, with dots or, by turns, rings, and
/// their names at the right.
/// Points that are not positive and finite are left out.
core::Image plot_picture(const Plot& plot);

}  // namespace interflect::visual

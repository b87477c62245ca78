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
    std::string panel = {};  ///< where curves are many, each panel has axes of its own
  };
  std::string title, x_label, y_label;
  std::vector<Curve> curves;
};

/// 1040 x 620 pixels a panel, sRGB in [0, 1]: a frame, a line a curve with markers, no two of which have the same
/// colour and marker, and their names at the right, in the order in which they reach the least y that all reach, with
/// the x of that.  More than eight curves are in panels, one below the other in the order of their first curves.
///
/// Points that are not positive and finite are left out.
core::Image plot_picture(const Plot& plot);

}  // namespace interflect::visual

#include "visual/comparison_picture.h"

#include "visual/legend.h"

namespace interflect::visual {

core::Image comparison_picture(const results::ComparisonPanels& panels, const std::array<std::string, 3>& titles,
                               double full_scale) {
  const double percent = 100 * full_scale;
  // Larger differences have the colours of the ends.
  const Legend legend{"%", results::ColourMap::blue_white_red, {-percent, percent}, true, true};
  return core::side_by_side({framed(panels.fem, titles[0], nullptr), framed(panels.traced, titles[1], nullptr),
                             framed(panels.difference, titles[2], &legend)},
                            0);
}

}  // namespace interflect::visual

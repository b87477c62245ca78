#include "visual/comparison_picture.h"

#include "core/format.h"
#include "visual/legend.h"

namespace interflect::visual {

core::Image comparison_picture(const results::ComparisonPanels& panels, std::uint64_t samples, double full_scale) {
  const double percent = 100 * full_scale;
  // Larger differences have the colours of the ends.
  const Legend legend{"%", results::ColourMap::blue_white_red, {-percent, percent}, true, true};
  const std::string traced = "path traced, " + core::format_count(samples) + " samples a pixel";
  return core::side_by_side(
      {framed(panels.fem, "radiosity, element by element", nullptr), framed(panels.traced, traced, nullptr),
       framed(panels.difference, "(radiosity - path traced) / mean, white within 3 standard errors", &legend)},
      0);
}

}  // namespace interflect::visual

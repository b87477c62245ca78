#include "measure/method.h"

namespace interflect::measure {

const PathClasses& Capabilities::paths_to(const Measurement& asked) const {
  if (std::holds_alternative<PixelRadiance>(asked)) return to_pixels;
  return std::holds_alternative<PointIrradiance>(asked) ? to_points : to_patches;
}

}  // namespace interflect::measure

#include "visual/hatching.h"

namespace interflect::visual::hatching {

namespace {

/// An eighteenth of the plane.
bool on_sparse_stripe(int x, int y, int period) { return 6 * ((x + y) % (3 * period)) < period; }

}  // namespace

bool hatch(Samples& samples, std::uint32_t faces, int period) {
  bool any = false;
  for (int y = 0; y < samples.height; ++y)
    for (int x = 0; x < samples.width; ++x) {
      const std::size_t place = samples.place(x, y);
      const std::uint32_t face = samples.faces[place];
      if (face == Samples::back || face > faces) continue;
      any = true;
      if (is_clear(face) ? on_sparse_stripe(x, y, period) : on_stripe(x, y, period)) samples.colours[place] = stripe;
    }
  return any;
}

}  // namespace interflect::visual::hatching

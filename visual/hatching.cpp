#include "visual/hatching.h"

#include <algorithm>

namespace interflect::visual::hatching {

namespace {

/// An eighteenth of the plane behind each of up to three clear bodies.  Stripes of one are among those of several.
/// @param along  x - y, and what makes it positive
bool on_sparse_stripe(int along, int bodies, int period) {
  const int several = std::min(bodies, 3);
  return 6 * ((several * (along % (3 * period))) % (3 * period)) < several * period;
}

}  // namespace

bool hatch(Samples& samples, std::uint32_t faces, int period) {
  bool any = false;
  for (int y = 0; y < samples.height; ++y)
    for (int x = 0; x < samples.width; ++x) {
      const std::size_t place = samples.place(x, y);
      const std::uint32_t face = samples.faces[place];
      const bool opaque = face != Samples::back && face <= faces;
      const int bodies = samples.clear_bodies(place);
      any = any || opaque || bodies > 0;
      if ((opaque && on_stripe(x, y, period)) ||
          (bodies > 0 && on_sparse_stripe(x + samples.height - 1 - y, bodies, period)))
        samples.colours[place] = stripe;
    }
  return any;
}

}  // namespace interflect::visual::hatching

#pragma once

#include "scene/scene.h"

namespace interflect::bench {

/// Prints the efficiency of the path tracer's picture of a scene's first camera at 128 x 128 pixels, one thread, by
/// each way of drawing its numbers:
///
///   efficiency = 1 / (e² t)  [1/s],   t: CPU seconds of the picture,
///   e² = mean over pixels of ((x - r) / max(r, m))²,   x, r: weighed radiance, picture and reference;  m: a tenth of r's mean
///
/// e is the relative RMSE as `interflect trace --target` means it.  The reference is of another seed, and its own variance,
/// which its standard errors tell, is taken off e²; pixels that see nothing are left out.  Of several pictures of different
/// seeds e² is the mean and t the median.  Beside it the same of RMSE over the mean radiance, of which pixels that a lamp's
/// edge crosses are nearly all.
void print_picture_efficiency(const scene::Scene& scene);

}  // namespace interflect::bench

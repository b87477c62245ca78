#pragma once

#include <cmath>

#include "core/hemisphere.h"
#include "montecarlo/bsdf/ggx.h"

namespace interflect::montecarlo {

/// Of light that arrives at facets at this cosine, what is scattered once: the mean of part(v, h) over the normals h that
/// are seen from v, by the numbers that they are drawn by.  Midpoints in t, u = 1 - (1 - t)³, since the steepest facets
/// are at the end of u; to 1e-5.
template <class Part>
double facet_albedo(const Ggx& facets, double cosine, const Part& part) {
  constexpr int n = 128;
  const Vec3 v(std::sqrt(std::max(0.0, 1 - cosine * cosine)), 0, cosine);
  double sum = 0;
  for (int a = 0; a < n; ++a) {
    const double left = 1 - (a + 0.5) / n;
    for (int b = 0; b < n; ++b)
      sum += 3 * left * left * part(v, facets.sample(v, 1 - left * left * left, (b + 0.5) / n));
  }
  return sum / (n * n);
}

/// Of what is drawn by a seen normal and weighs G2 / G1.
inline double facet_weight(const Ggx& facets, const Vec3& v, const Vec3& way) {
  return facets.visible(v, way) / facets.visible(v);
}

}  // namespace interflect::montecarlo

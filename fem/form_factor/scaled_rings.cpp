#include "fem/form_factor/scaled_rings.h"

#include <algorithm>
#include <cmath>

namespace interflect::fem {

int unit_exponent(std::span<const Vec3> a, std::span<const Vec3> b) {
  double extent = 0.0;
  for (const auto& ring : {a, b})
    for (const Vec3& p : ring) extent = std::max(extent, (p - a.front()).cwiseAbs().maxCoeff());
  int exponent = 0;
  std::frexp(extent, &exponent);
  return exponent;
}

Integral in_square_metres(const Integral& contour, int unit_exponent) {
  const auto scale = [&](double x) { return std::ldexp(0.5 * inv_pi * x, 2 * unit_exponent); };
  return {scale(contour.value), scale(contour.error)};
}

ScaledRings::ScaledRings(std::span<const Vec3> a, std::span<const Vec3> b)
    : corners_of_a_(a.size()), exponent_(unit_exponent(a, b)) {
  const double scale = std::ldexp(1.0, -exponent_);
  edges_.reserve(a.size() + b.size());
  for (const auto& ring : {a, b})
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Vec3 &from = ring[k], &to = ring[(k + 1) % ring.size()];
      edges_.push_back(edge_between(scale * (from - a.front()), scale * (to - a.front())));
    }
}

}  // namespace interflect::fem

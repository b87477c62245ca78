#include "validation/agreement.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "validation/judged.h"

namespace interflect::validation {
namespace {

constexpr double rounding = 1e-12;  ///< of the values, that two exact answers may differ by

/// With the sign of a - b; infinite where a value, its noise or its bound is not known.
double signed_z_of(const Reading& reading, const Estimate& a, const Estimate& b) {
  const double x = reading.value(a.value), y = reading.value(b.value);
  const double noise = std::hypot(reading.noise(a).standard_error, reading.noise(b).standard_error);
  const double bound = reading.error(a.error_bound) + reading.error(b.error_bound);
  if (!std::isfinite(x - y) || !std::isfinite(noise + bound)) return std::numeric_limits<double>::infinity();
  const double excess = std::abs(x - y) - bound - rounding * std::max(std::abs(x), std::abs(y));
  return excess > 0 ? std::copysign(excess / noise, x - y) : 0;
}

}  // namespace

std::size_t comparisons_of(const scene::Scene& scene, std::size_t measurements) {
  return measurements * readings_of(scene).size();
}

Agreement agreement(const scene::Scene& scene, std::span<const Estimate> a, std::span<const Estimate> b, double z_max) {
  Agreement found;
  found.comparisons = comparisons_of(scene, a.size());
  for (std::size_t m = 0; m < a.size(); ++m)
    for (const Reading& reading : readings_of(scene)) {
      const double signed_z = signed_z_of(reading, a[m], b[m]), z = std::abs(signed_z);
      if (reading.of_scene) found.mean_z += signed_z / static_cast<double>(a.size());
      if (!(z <= z_max)) ++found.beyond;
      if (!(z <= found.largest_z)) found.largest_z = z, found.worst = m;
    }
  return found;
}

}  // namespace interflect::validation

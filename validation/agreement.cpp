#include "validation/agreement.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/batch_means.h"
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

MeanAgreement mean_agreement(const scene::Scene& scene, const Replicated& a, const Replicated& b, double level) {
  MeanAgreement found;
  if (a.again.size() < 2) return found;
  const Reading reading = readings_of(scene).front();
  const int replications = static_cast<int>(a.again.size());
  core::BatchMeans apart(replications);
  double bounds = 0;
  for (std::size_t m = 0; m < a.found.size(); ++m) {
    const double noise = std::hypot(reading.noise(a.found[m]).standard_error, reading.noise(b.found[m]).standard_error);
    if (!(noise > 0 && std::isfinite(noise))) continue;  // each z is judged there, and says what it is
    for (int k = 0; k < replications; ++k) {
      const Estimate &of_a = a.again[static_cast<std::size_t>(k)][m], &of_b = b.again[static_cast<std::size_t>(k)][m];
      apart.add(k, (reading.value(of_a.value) - reading.value(of_b.value)) / noise);
    }
    bounds += (reading.error(a.found[m].error_bound) + reading.error(b.found[m].error_bound)) / noise;
  }
  if (apart.batch(0).count() == 0) return found;
  found.judged = true;
  found.mean = apart.mean();
  found.allowed = apart.half_width(1 - level) + bounds / static_cast<double>(apart.batch(0).count());
  return found;
}

}  // namespace interflect::validation

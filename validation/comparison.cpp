#include "validation/comparison.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace interflect::validation {

namespace {

constexpr double rounding = 1e-12;

/// Sums behind the mean of z.
struct Drift {
  double z = 0, z_square = 0, bound = 0, mc = 0, fem = 0;

  void add(const Difference& d, double se_fem, double se_mc) {
    z += d.z;
    z_square += d.z * d.z;
    bound += d.bound / d.standard_error;
    mc += (se_mc / d.standard_error) * (se_mc / d.standard_error);
    fem += se_fem / d.standard_error;
  }
};

void sort_worst_first(std::vector<std::size_t>& which, const std::vector<Difference>& differences) {
  const auto badness = [&](std::size_t i) {
    const Difference& d = differences[i];
    return d.known ? std::abs(d.excess_z) : std::numeric_limits<double>::infinity();
  };
  std::stable_sort(which.begin(), which.end(), [&](std::size_t a, std::size_t b) { return badness(a) > badness(b); });
}

}  // namespace

Difference difference(const Judged& judged, const Reading& reading) {
  Difference d;
  d.fem = reading.value(judged.fem.value);
  d.mc = reading.value(judged.mc.value);
  d.standard_error = std::hypot(reading.noise(judged.fem).standard_error, reading.noise(judged.mc).standard_error);
  d.bound = reading.error(judged.fem.error_bound) + reading.error(judged.mc.error_bound);
  d.known = std::isfinite(d.fem) && std::isfinite(d.mc) && std::isfinite(d.standard_error) && std::isfinite(d.bound);
  if (!d.known) return d;

  const double slack = rounding * std::max(std::abs(d.fem), std::abs(d.mc));
  const double size = std::abs(d.difference()), excess = std::max(0.0, size - d.bound - slack);
  d.agrees = size <= d.bound + 3 * d.standard_error + slack;
  if (d.standard_error > 0) {
    d.z = d.difference() / d.standard_error;
    d.excess_z = std::copysign(excess / d.standard_error, d.difference());
  } else if (excess > 0) {  // two exact answers that differ: infinitely unlikely
    d.z = d.excess_z = std::copysign(std::numeric_limits<double>::infinity(), d.difference());
  }
  return d;
}

Comparison compare(std::span<const Judged> judged, const Reading& reading, double z_max) {
  Comparison all;
  all.z_max = z_max;
  Drift drift;
  for (std::size_t i = 0; i < judged.size(); ++i) {
    const Difference& d = all.differences.emplace_back(difference(judged[i], reading));
    if (!d.agrees) all.disagreeing.push_back(i);
    if (!d.known) all.unknown.push_back(i);
    if (std::abs(d.excess_z) > z_max) all.beyond_chance.push_back(i);
    if (!d.known || d.standard_error <= 0) continue;
    drift.add(d, reading.noise(judged[i].fem).standard_error, reading.noise(judged[i].mc).standard_error);
    ++all.noisy;
  }
  if (!judged.empty()) all.share = 1 - static_cast<double>(all.disagreeing.size()) / static_cast<double>(judged.size());
  if (const auto n = static_cast<double>(all.noisy); all.noisy > 0) {
    all.mean_z = drift.z / n;
    all.mean_z_square = drift.z_square / n;
    all.mean_z_limit = (drift.bound + z_max * std::sqrt(drift.mc + drift.fem * drift.fem)) / n;
  }
  sort_worst_first(all.disagreeing, all.differences);
  sort_worst_first(all.beyond_chance, all.differences);
  return all;
}

}  // namespace interflect::validation

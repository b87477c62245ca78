#include "montecarlo/tally.h"

#include <algorithm>
#include <cmath>

#include "core/format.h"
#include "core/log.h"

namespace interflect::montecarlo {

void Tally::add(const Spectrum& sample, double weighed_sample, std::uint64_t index, const Spectrum& light) {
  const bool fine = sample.is_finite();
  if (!fine && not_finite++ == 0) first_not_finite = index;
  moments.add(fine ? sample : Spectrum::zero());
  weighed.add(fine ? weighed_sample : 0);
  for (int c = 0; c < Spectrum::capacity; ++c) without_light[c] += light[c] == 0;
  if (!fine) return;
  largest_sample = std::max(largest_sample, std::abs(weighed_sample));
  sum_of_sizes += std::abs(weighed_sample);
}

void Tally::merge(const Tally& other) {
  moments.merge(other.moments);
  weighed.merge(other.weighed);
  largest_sample = std::max(largest_sample, other.largest_sample);
  sum_of_sizes += other.sum_of_sizes;
  without_light += other.without_light;
  if (not_finite == 0) first_not_finite = other.first_not_finite;
  not_finite += other.not_finite;
}

double Tally::share_of_one() const { return sum_of_sizes > 0 ? largest_sample / sum_of_sizes : 0; }

bool Tally::found_none() const {
  for (int c = 0; c < Spectrum::capacity; ++c)
    if (without_light[c] != static_cast<double>(moments.count())) return false;
  return true;
}

Estimate Tally::estimate(const Spectrum& largest) const {
  Estimate found = unbiased_estimate(moments.mean(), moments.standard_error(), moments.count());
  found.weighed_standard_error = weighed.standard_error();
  for (int c = 0; c < Spectrum::capacity; ++c) {
    const bool scored = found.value[c] != 0 || found.standard_error[c] != 0;
    if (!(largest[c] > 0) || (scored && without_light[c] != static_cast<double>(found.samples))) continue;
    found.standard_error[c] = std::max(found.standard_error[c], 3 * largest[c] / static_cast<double>(found.samples));
    found.weighed_standard_error = std::numeric_limits<double>::quiet_NaN();
  }
  if (not_finite > 0) {
    found.error_bound = Spectrum(std::numeric_limits<double>::infinity());
    found.claim = Claim::none;
  }
  return found;
}

double weighed_standard_error(const scene::Scene& scene, const Estimate& estimate) {
  return std::isfinite(estimate.weighed_standard_error) ? estimate.weighed_standard_error
                                                        : scene.weigh(estimate.standard_error);
}

void warn_of_bugs(const Tally& tally, const char* who, std::size_t measurement, std::uint64_t seed) {
  if (tally.not_finite == 0) return;
  core::log::warning(core::format(
      "%s: %llu samples of measurement %zu are not finite and count as zero (first: seed %llu, sample %llu)", who,
      static_cast<unsigned long long>(tally.not_finite), measurement, static_cast<unsigned long long>(seed),
      static_cast<unsigned long long>(tally.first_not_finite)));
}

}  // namespace interflect::montecarlo

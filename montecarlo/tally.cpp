#include "montecarlo/tally.h"

#include <algorithm>
#include <cmath>

#include "core/format.h"
#include "core/log.h"

namespace interflect::montecarlo {

void Tally::add(const Spectrum& sample, double weighed_sample, std::uint64_t index) {
  const bool fine = sample.is_finite();
  if (!fine && not_finite++ == 0) first_not_finite = index;
  moments.add(fine ? sample : Spectrum::zero());
  weighed.add(fine ? weighed_sample : 0);
  if (fine) largest_sample = std::max(largest_sample, std::abs(weighed_sample));
}

void Tally::merge(const Tally& other) {
  moments.merge(other.moments);
  weighed.merge(other.weighed);
  largest_sample = std::max(largest_sample, other.largest_sample);
  if (not_finite == 0) first_not_finite = other.first_not_finite;
  not_finite += other.not_finite;
}

double Tally::share_of_one() const {
  const double all = std::abs(weighed.mean()) * static_cast<double>(weighed.count());
  return all > 0 ? std::min(1.0, largest_sample / all) : 0;  // of filters that subtract it may be more than all
}

Estimate Tally::estimate(const Spectrum& largest) const {
  Estimate found = unbiased_estimate(moments.mean(), moments.standard_error(), moments.count());
  found.weighed_standard_error = weighed.standard_error();
  for (int c = 0; c < Spectrum::capacity; ++c)
    if (found.value[c] == 0 && found.standard_error[c] == 0 && largest[c] > 0) {
      found.standard_error[c] = 3 * largest[c] / static_cast<double>(found.samples);
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

#include "montecarlo/sample_report.h"

#include <algorithm>

#include "core/format.h"

namespace interflect::montecarlo {

void SampleReport::add(std::size_t measurement, const Tally& tally) {
  not_finite += tally.not_finite;
  const double share = tally.share_of_one(), count = static_cast<double>(tally.moments.count());
  if (share > std::max(heavy_share, heavy_over_mean / count)) heavy.push_back({measurement, share});
}

void SampleReport::add(const SampleReport& part, std::span<const std::size_t> of) {
  not_finite += part.not_finite;
  for (const Heavy& each : part.heavy) heavy.push_back({of[each.measurement], each.share});
}

std::string SampleReport::heavy_text(const std::vector<std::string>& names) const {
  if (heavy.empty()) return {};
  const Heavy& worst = *std::ranges::max_element(heavy, {}, &Heavy::share);
  std::string text = core::format("one sample carries %.2g %% of %s: its error may be understated", 100 * worst.share,
                                  names[worst.measurement].c_str());
  if (heavy.size() > 1) text += core::format("; so in %zu of %zu", heavy.size(), names.size());
  return text;
}

}  // namespace interflect::montecarlo

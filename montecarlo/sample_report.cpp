#include "montecarlo/sample_report.h"

#include <algorithm>

#include "core/format.h"

namespace interflect::montecarlo {

void SampleReport::add(std::size_t measurement, const Tally& tally) {
  not_finite += tally.not_finite;
  const double share = tally.share_of_one();
  if (tally.moments.count() >= heavy_fewest && share > heavy_share) heavy.push_back({measurement, share});
}

void SampleReport::add(const SampleReport& part, std::span<const std::size_t> of) {
  not_finite += part.not_finite;
  if (!part.rare.empty() && (rare.empty() || part.rare_samples < rare_samples)) {
    rare = part.rare;
    rare_samples = part.rare_samples;
    rare_measurement = of[part.rare_measurement];
  }
  for (const Heavy& each : part.heavy) heavy.push_back({of[each.measurement], each.share});
}

const SampleReport::Heavy& SampleReport::worst() const { return *std::ranges::max_element(heavy, {}, &Heavy::share); }

std::string SampleReport::heavy_text(const std::vector<std::string>& names) const {
  if (heavy.empty()) return {};
  std::string text = core::format("one sample carries %.2g %% of %s: its error may be understated", 100 * worst().share,
                                  names[worst().measurement].c_str());
  if (heavy.size() > 1) text += core::format("; so in %zu of %zu", heavy.size(), names.size());
  return text;
}

std::string SampleReport::rare_text(const std::vector<std::string>& names) const {
  return rare.empty() ? rare : names[rare_measurement] + ": " + rare;
}

std::string SampleReport::heavy_text_of_picture(int width, int height) const {
  const double share = static_cast<double>(heavy.size()) / (static_cast<double>(width) * static_cast<double>(height));
  if (!(share >= heavy_pixels)) return {};
  const auto row = static_cast<std::size_t>(width);
  return core::format(
      "in %.2g %% of the pixels one sample carries much, most in (%zu, %zu), %.2g %%: such light is found rarely, and "
      "errors may be understated",
      100 * share, worst().measurement % row, worst().measurement / row, 100 * worst().share);
}

}  // namespace interflect::montecarlo

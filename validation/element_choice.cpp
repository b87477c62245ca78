#include "validation/element_choice.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.h"
#include "core/random.h"

namespace interflect::validation {

namespace {

struct Stratum {
  std::size_t first = 0, size = 0;  ///< elements
  double area = 0;
  std::size_t chosen = 0;
  double represented = 0;  ///< area that its chosen elements share
};

std::vector<Stratum> strata_of(std::span<const double> areas, std::span<const std::uint32_t> surface_of) {
  std::vector<Stratum> strata;
  for (std::size_t i = 0; i < areas.size(); ++i) {
    if (i == 0 || surface_of[i] != surface_of[i - 1]) strata.push_back({.first = i});
    ++strata.back().size;
    strata.back().area += areas[i];
  }
  return strata;
}

/// At least one each, then by largest remainders of what is proportional to area, never more than a stratum has.
void share_out(std::vector<Stratum>& strata, std::size_t count, double area) {
  std::size_t given = 0;
  std::vector<double> due(strata.size());
  for (std::size_t s = 0; s < strata.size(); ++s) {
    due[s] = static_cast<double>(count) * strata[s].area / area;
    strata[s].chosen = std::clamp<std::size_t>(static_cast<std::size_t>(due[s]), 1, strata[s].size);
    strata[s].represented = strata[s].area;
    given += strata[s].chosen;
  }
  std::vector<std::size_t> order(strata.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto short_of = [&](std::size_t s) { return due[s] - static_cast<double>(strata[s].chosen); };
  while (given != count) {  // small surfaces got more than their due, or full ones less: the others make up for it
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return short_of(a) > short_of(b); });
    const std::size_t before = given;
    if (given < count)
      for (auto s = order.begin(); s != order.end() && given < count; ++s)
        if (strata[*s].chosen < strata[*s].size) ++strata[*s].chosen, ++given;
    if (given > count)
      for (auto s = order.rbegin(); s != order.rend() && given > count; ++s)
        if (strata[*s].chosen > 1) --strata[*s].chosen, --given;
    if (given == before) throw core::PreconditionError("choose_elements: shares do not add up");
  }
}

/// Fewer elements than surfaces: `count` equal steps along the surfaces' areas; each step stands for area / count.
void draw_surfaces(std::vector<Stratum>& strata, std::size_t count, double area, double u) {
  const double step = area / static_cast<double>(count);
  double end = 0;
  std::size_t taken = 0;
  for (Stratum& s : strata) {
    end += s.area;
    while (taken < count && (static_cast<double>(taken) + u) * step < end) {
      ++taken;
      s.chosen = std::min(s.chosen + 1, s.size);
      s.represented += step;
    }
  }
}

void draw_elements(const Stratum& s, std::span<const double> areas, double u, std::vector<ChosenElement>& chosen) {
  const double step = static_cast<double>(s.size) / static_cast<double>(s.chosen);
  const std::size_t begin = chosen.size();
  double area = 0;
  for (std::size_t k = 0; k < s.chosen; ++k) {
    const auto nth = std::min(s.size - 1, static_cast<std::size_t>((static_cast<double>(k) + u) * step));
    chosen.push_back({static_cast<std::int64_t>(s.first + nth), areas[s.first + nth]});
    area += areas[s.first + nth];
  }
  for (std::size_t k = begin; k < chosen.size(); ++k) chosen[k].represented_area *= s.represented / area;
}

}  // namespace

std::vector<ChosenElement> choose_elements(std::span<const double> areas, std::span<const std::uint32_t> surface_of,
                                           std::size_t count, std::uint64_t seed) {
  if (areas.size() != surface_of.size())
    throw core::PreconditionError("choose_elements: one surface per element expected");
  std::vector<ChosenElement> chosen;
  if (count >= areas.size()) {
    for (std::size_t i = 0; i < areas.size(); ++i) chosen.push_back({static_cast<std::int64_t>(i), areas[i]});
    return chosen;
  }
  if (count == 0) return chosen;
  const double area = std::accumulate(areas.begin(), areas.end(), 0.0);
  std::vector<Stratum> strata = strata_of(areas, surface_of);
  const std::uint64_t key = core::derived_seed(seed, "validation: choice of elements");
  if (count >= strata.size())
    share_out(strata, count, area);
  else
    draw_surfaces(strata, count, area, core::RandomNumbers(key, 1, 0).next());
  for (std::size_t s = 0; s < strata.size(); ++s)
    if (strata[s].chosen > 0) draw_elements(strata[s], areas, core::RandomNumbers(key, 0, s).next(), chosen);
  return chosen;
}

}  // namespace interflect::validation

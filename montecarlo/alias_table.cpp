#include "montecarlo/alias_table.h"

#include <numeric>

#include "core/error.h"

namespace interflect::montecarlo {

AliasTable::AliasTable(std::span<const double> weights)
    : cells_(weights.size()), total_(std::accumulate(weights.begin(), weights.end(), 0.0)) {
  if (weights.empty()) return;
  if (!(total_ > 0)) throw core::PreconditionError("an alias table needs a positive weight");
  // Each cell holds 1/n of the probability: items with less than that are topped up by one with more.
  std::vector<double> share(weights.size());
  std::vector<std::uint32_t> small, large;
  for (std::uint32_t i = 0; i < weights.size(); ++i) {
    share[i] = weights[i] * static_cast<double>(weights.size()) / total_;
    (share[i] < 1 ? small : large).push_back(i);
  }
  while (!small.empty() && !large.empty()) {
    const std::uint32_t poor = small.back(), rich = large.back();
    small.pop_back();
    cells_[poor] = {share[poor], rich};
    share[rich] -= 1 - share[poor];
    if (share[rich] < 1) large.pop_back(), small.push_back(rich);
  }
  // What is left has share 1 up to rounding.
  for (const auto* rest : {&small, &large})
    for (std::uint32_t i : *rest) cells_[i] = {1, i};
}

}  // namespace interflect::montecarlo

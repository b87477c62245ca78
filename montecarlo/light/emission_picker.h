#pragma once

#include <vector>

#include "montecarlo/alias_table.h"
#include "montecarlo/light/light_set.h"

namespace interflect::montecarlo {

/// The light that a walk sets out from: each with probability Phi / sum Phi, in its largest channel.
class EmissionPicker {
 public:
  explicit EmissionPicker(const LightSet& lights);

  bool empty() const { return by_flux_.size() == 0; }  ///< nothing shines
  /// @param u  uniform in [0, 1)
  LightSet::Picked pick(double u) const {
    const std::uint32_t light = by_flux_.pick(u);
    return {light, probability(light)};
  }
  double probability(std::uint32_t light) const { return probability_[light]; }

 private:
  AliasTable by_flux_;
  std::vector<double> probability_;
};

}  // namespace interflect::montecarlo

#include "montecarlo/light/emission_picker.h"

#include <numeric>

namespace interflect::montecarlo {

EmissionPicker::EmissionPicker(const LightSet& lights) {
  for (std::uint32_t l = 0; l < lights.size(); ++l) probability_.push_back(lights[l].flux().max());
  const double all = std::accumulate(probability_.begin(), probability_.end(), 0.0);
  if (!(all > 0)) return;
  by_flux_ = AliasTable(probability_);
  for (double& each : probability_) each /= all;
}

}  // namespace interflect::montecarlo

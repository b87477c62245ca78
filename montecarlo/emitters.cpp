#include "montecarlo/emitters.h"

#include "montecarlo/warp.h"

namespace interflect::montecarlo {

Emitters::Emitters(const scene::Scene& scene) : pdf_area_(scene.facets.size(), 0.0) {
  std::vector<double> power;
  for (std::size_t i = 0; i < scene.facets.size(); ++i) {
    const scene::Facet& facet = scene.facets[i];
    const Spectrum exitance = scene.material(facet.surface).exitance_of(scene::Side::front);
    if (exitance.is_zero()) continue;
    pdf_area_[i] = exitance.max();  // divided by the total below
    emitters_.push_back({facet.corner, facet.normal, exitance, exitance.max()});
    power.push_back(facet.area * exitance.max());
    for (int c = 0; c < Spectrum::capacity; ++c) max_exitance_[c] = std::max(max_exitance_[c], exitance[c]);
  }
  picks_ = AliasTable(power);
  if (empty()) return;
  for (Emitter& emitter : emitters_) emitter.pdf_area /= picks_.total();
  for (double& pdf : pdf_area_) pdf /= picks_.total();
}

EmitterSample Emitters::sample(double pick, double u, double v) const {
  const Emitter& emitter = emitters_[picks_.pick(pick)];
  const auto& [a, b, c] = emitter.corner;
  return {triangle_point(a, b, c, u, v), emitter.normal, emitter.exitance, emitter.pdf_area};
}

}  // namespace interflect::montecarlo

#include "fem/specular/smooth_surface.h"

#include <cmath>

#include "core/fresnel.h"
#include "core/overloaded.h"
#include "scene/smoothness.h"

namespace interflect::fem {
namespace {

SmoothParts parts_of(const scene::Metal& metal, double cosine) {
  SmoothParts parts;
  if (const auto* index = std::get_if<scene::Metal::Index>(&metal.reflects)) {
    for (int c = 0; c < Spectrum::capacity; ++c)
      if (index->eta[c] > 0) parts.reflected[c] = core::fresnel(cosine, index->eta[c], index->k[c]).mean();
    return parts;
  }
  const double grazing = std::pow(1 - cosine, 5);
  parts.reflected = std::get<Spectrum>(metal.reflects).map([&](double r) { return r + (1 - r) * grazing; });
  return parts;
}

SmoothParts parts_of(const scene::Glass& glass, double cosine, scene::Side side) {
  if (scene::is_unseen(glass)) return {Spectrum::zero(), Spectrum(1)};
  const double eta = side == scene::Side::front ? glass.index : 1 / glass.index;
  const double F = core::fresnel(cosine, eta).mean();
  return {Spectrum(F), Spectrum(1 - F), eta};
}

SmoothParts parts_of(const scene::Pane& pane, double cosine) {
  SmoothParts parts;
  for (int c = 0; c < Spectrum::capacity; ++c) {
    const core::Pane::Parts of = core::Pane::of(pane.index, pane.transmittance[c])(cosine);
    parts.reflected[c] = of.reflected, parts.passed[c] = of.transmitted;
  }
  return parts;
}

}  // namespace

bool is_smooth(const scene::Material& material) {
  if (material.opacity < 1) return false;
  return std::visit(
      core::Overloaded{
          [](const scene::Mirror&) { return true; }, [](const scene::Pane&) { return true; },
          [](const scene::Metal& metal) { return scene::is_smooth(metal.roughness); },
          [](const scene::Glass& glass) { return scene::is_smooth(glass.roughness) || scene::is_unseen(glass); },
          [](const scene::Lambertian&) { return false; }, [](const scene::Plastic&) { return false; }},
      material.finish);
}

SmoothParts smooth_parts(const scene::Material& material, double cosine, scene::Side side) {
  return std::visit(core::Overloaded{[](const scene::Mirror& mirror) {
                                       return SmoothParts{mirror.reflectance, {}};
                                     },
                                     [&](const scene::Metal& metal) { return parts_of(metal, cosine); },
                                     [&](const scene::Glass& glass) { return parts_of(glass, cosine, side); },
                                     [&](const scene::Pane& pane) { return parts_of(pane, cosine); },
                                     [](const auto&) { return SmoothParts{}; }},
                    material.finish);
}

}  // namespace interflect::fem

#include "montecarlo/bsdf/of_material.h"

#include "montecarlo/bsdf/lambert.h"
#include "montecarlo/bsdf/mask.h"
#include "montecarlo/bsdf/plastic.h"
#include "montecarlo/bsdf/rough_conductor.h"
#include "montecarlo/bsdf/rough_dielectric.h"
#include "montecarlo/bsdf/smooth.h"
#include "scene/smoothness.h"

namespace interflect::montecarlo {
namespace {

using Made = std::unique_ptr<Bsdf>;

Made made(const scene::Lambertian&, const Spectrum& diffuse) {
  return diffuse.is_zero() ? nullptr : std::make_unique<Lambert>(diffuse);
}
Made made(const scene::Mirror& mirror, const Spectrum&) { return std::make_unique<Mirror>(mirror.reflectance); }
Made made(const scene::Metal& metal, const Spectrum&) {
  const auto* index = std::get_if<scene::Metal::Index>(&metal.reflects);
  MetalFresnel fresnel = index ? MetalFresnel(MetalFresnel::ComplexIndex{index->eta, index->k})
                               : MetalFresnel(std::get<Spectrum>(metal.reflects));
  if (scene::is_smooth(metal.roughness)) return std::make_unique<PolishedMetal>(std::move(fresnel));
  return std::make_unique<RoughConductor>(metal.roughness, std::move(fresnel));
}
Made made(const scene::Glass& glass, const Spectrum&) {
  if (scene::is_unseen(glass)) return std::make_unique<Mask>(0, nullptr);
  if (scene::is_smooth(glass.roughness)) return std::make_unique<Dielectric>(glass.index);
  return std::make_unique<RoughDielectric>(glass.roughness, glass.index);
}
Made made(const scene::Pane& pane, const Spectrum&) {
  return std::make_unique<ThinPane>(pane.index, pane.transmittance);
}
Made made(const scene::Plastic& plastic, const Spectrum& diffuse) {
  return std::make_unique<Plastic>(plastic.index, diffuse);
}

Scatters scatters(const scene::Lambertian&, const Spectrum& diffuse) { return {.diffuse = !diffuse.is_zero()}; }
Scatters scatters(const scene::Mirror&, const Spectrum&) { return {.specular = true}; }
Scatters scatters(const scene::Metal& metal, const Spectrum&) {
  return {.glossy = !scene::is_smooth(metal.roughness), .specular = scene::is_smooth(metal.roughness)};
}
Scatters scatters(const scene::Glass& glass, const Spectrum&) {
  if (scene::is_unseen(glass)) return {};
  return {.glossy = !scene::is_smooth(glass.roughness), .specular = scene::is_smooth(glass.roughness)};
}
Scatters scatters(const scene::Pane&, const Spectrum&) { return {.specular = true}; }
Scatters scatters(const scene::Plastic&, const Spectrum&) { return {.diffuse = true, .specular = true}; }

}  // namespace

Scatters scatters_of(const scene::Material& material) {
  if (material.opacity == 0) return {};
  return std::visit([&](const auto& finish) { return scatters(finish, material.reflectance); }, material.finish);
}

Made bsdf_of(const scene::Material& material) {
  Made bsdf = std::visit([&](const auto& finish) { return made(finish, material.reflectance); }, material.finish);
  if (bsdf && material.sides == scene::Sides::front) {
    if (std::holds_alternative<scene::Lambertian>(material.finish))  // what most paths meet: without a detour
      bsdf = std::make_unique<Lambert>(material.reflectance, Lambert::On::front);
    else
      bsdf = std::make_unique<FrontOnly>(std::move(bsdf));
  }
  if (material.opacity < 1) bsdf = std::make_unique<Mask>(material.opacity, std::move(bsdf));
  return bsdf;
}

}  // namespace interflect::montecarlo

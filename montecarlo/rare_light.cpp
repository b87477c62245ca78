#include "montecarlo/rare_light.h"

#include <algorithm>
#include <cmath>

#include "core/format.h"
#include "montecarlo/scene_paths.h"

namespace interflect::montecarlo {
namespace {

void add(const std::string& name, double chance, const Spectrum& pi_radiance, RareLight& rarest) {
  if (chance < rarest.chance) rarest = {name, chance, pi_radiance};
}

double combined(double a, double b) { return std::sqrt(a * a + b * b); }

}  // namespace

std::optional<RareLight> rare_light(const scene::Scene& scene, const measure::PathClasses& paths) {
  if ((paths_in(scene) & paths & measure::PathClasses::of("(A|F)S.*E")).empty()) return std::nullopt;
  const double radius = scene.box().diagonal().norm() / 2;
  RareLight rarest{"", 1, Spectrum::zero()};
  for (const scene::SurfaceId id : scene.surface_ids())
    for (const scene::Side side : {scene::Side::front, scene::Side::back})
      if (const Spectrum exitance = scene.material(id).exitance_of(side); !exitance.is_zero())
        add(scene.surface(id).name, scene.area(id) / (pi * radius * radius), exitance, rarest);
  for (const scene::SphereLight& ball : scene.lights.spheres)
    if (!ball.exitance.is_zero()) add(ball.name, std::pow(ball.radius / radius, 2), ball.exitance, rarest);
  for (const scene::Sun& sun : scene.lights.suns)
    if (sun.one_minus_cosine() > 0) add(sun.name, sun.squared_sine(), pi * sun.radiance(), rarest);
  return rarest.chance < 1 ? std::optional(rarest) : std::nullopt;
}

void RareLight::widen(const scene::Scene& scene, double scale, Estimate& estimate) const {
  const Spectrum lacks = pi_radiance * (scale * std::min(3.0 / static_cast<double>(estimate.samples), chance));
  for (int c = 0; c < Spectrum::capacity; ++c)
    estimate.standard_error[c] = combined(estimate.standard_error[c], lacks[c]);
  estimate.weighed_standard_error = combined(estimate.weighed_standard_error, scene.weigh(lacks));
}

std::string RareLight::text(std::uint64_t samples) const {
  return core::format(
      "light of %s by way of mirrors or smooth glass is met by one path in %.0f at most, and %llu were taken: errors "
      "allow for its image in one flat mirror, and know of no more",
      light.c_str(), 1 / chance, static_cast<unsigned long long>(samples));
}

}  // namespace interflect::montecarlo

#include "montecarlo/rare_light.h"

#include <algorithm>
#include <cmath>

#include "core/format.h"
#include "montecarlo/scene_paths.h"

namespace interflect::montecarlo {

RareLights::RareLights(const scene::Scene& scene, const measure::PathClasses& paths, NextEvent next_event)
    : by_mirrors_(next_event == NextEvent::yes) {
  const measure::PathClasses there = paths_in(scene) & paths;
  const auto may_be = [&](const char* light) {
    const std::string by_chance = std::string(light) + (by_mirrors_ ? "S.*E" : ".*E");
    return !(there & measure::PathClasses::of(by_chance)).empty();
  };
  const double radius = scene.box().diagonal().norm() / 2;
  if (may_be("A")) {
    for (const scene::SurfaceId id : scene.surface_ids())
      for (const scene::Side side : {scene::Side::front, scene::Side::back})
        if (const Spectrum exitance = scene.material(id).exitance_of(side); !exitance.is_zero())
          lights_.push_back({scene.surface(id).name, scene.area(id) / (pi * radius * radius), false, exitance});
    for (const scene::SphereLight& ball : scene.lights.spheres)
      if (!ball.exitance.is_zero())
        lights_.push_back({ball.name, std::pow(ball.radius / radius, 2), false, ball.exitance});
  }
  if (may_be("F"))
    for (const scene::Sun& sun : scene.lights.suns)
      if (sun.one_minus_cosine() > 0 && !sun.irradiance.is_zero())
        lights_.push_back({sun.name, sun.squared_sine(), true, pi * sun.radiance()});
}

Spectrum RareLights::RareLight::lacks(double samples, double otherwise) const {
  if (samples >= samples_to_meet(otherwise)) return Spectrum::zero();
  return find(otherwise) * std::min(3 / samples, anywhere ? met_by(otherwise) : 1.0);
}

Spectrum RareLights::lacks(std::uint64_t samples, double otherwise) const {
  Spectrum squares;
  for (const RareLight& light : lights_) {
    const Spectrum of_this = light.lacks(static_cast<double>(samples), otherwise);
    squares += of_this * of_this;
  }
  for (int c = 0; c < Spectrum::capacity; ++c) squares[c] = std::sqrt(squares[c]);
  return squares;
}

double RareLights::samples_for(double wanted, const scene::Scene& scene, double otherwise) const {
  const double of_each = wanted / std::sqrt(static_cast<double>(lights_.size()));
  double samples = 0;
  for (const RareLight& light : lights_) {
    const double find = scene.weigh(light.find(otherwise));
    if (light.anywhere && light.met_by(otherwise) * find <= of_each) continue;
    samples = std::max(samples, std::min(3 * find / of_each, light.samples_to_meet(otherwise)));
  }
  return samples;
}

std::string RareLights::text(const scene::Scene& scene, std::uint64_t samples) const {
  const auto lacked = [&](const RareLight& light) { return scene.weigh(light.lacks(static_cast<double>(samples), 0)); };
  const RareLight& most = *std::ranges::max_element(lights_, {}, lacked);
  return core::format(
      "light of %s%s is met by one path in %.0f or so, and %llu were taken: errors allow for some that none has met",
      most.name.c_str(), by_mirrors_ ? " by way of mirrors or smooth glass" : "", 1 / most.chance,
      static_cast<unsigned long long>(samples));
}

}  // namespace interflect::montecarlo

#include "montecarlo/lamps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace interflect::montecarlo {
namespace {

constexpr std::size_t most_lamps = 1000;

/// By the power of 2 of their largest channel.
using ByMagnitude = std::map<int, AlikeLamps>;
int magnitude_of(const Spectrum& pi_radiance) { return std::ilogb(pi_radiance.max()); }

void add(ByMagnitude& to, const Spectrum& pi_radiance, const Spectrum& arriving, const Lamp& lamp) {
  AlikeLamps& alike = to[magnitude_of(pi_radiance)];
  alike.pi_radiance = max(alike.pi_radiance, pi_radiance);
  alike.arriving += arriving;
  alike.lamps.push_back(lamp);
}

Lamp least_of(const std::vector<Lamp>& lamps) {
  Lamp least = lamps.front();
  for (const Lamp& each : lamps) {
    if (each.area < least.area) least.name = each.name, least.area = each.area;
    least.picked = std::min(least.picked, each.picked);
    least.box.extend(each.box);
  }
  return least;
}

std::vector<AlikeLamps> listed(ByMagnitude& by_magnitude) {
  std::vector<AlikeLamps> all;
  for (auto& [magnitude, alike] : by_magnitude) {
    if (alike.lamps.size() > most_lamps) alike.lamps = {least_of(alike.lamps)};
    all.push_back(std::move(alike));
  }
  return all;
}

/// Surfaces of a magnitude that have a corner in common, and those that have one with these, have one root.
class Joined {
 public:
  explicit Joined(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }
  std::size_t root(std::size_t k) {
    while (parent_[k] != k) k = parent_[k] = parent_[parent_[k]];
    return k;
  }
  void add_corner(std::size_t k, int magnitude, const Vec3& at) {
    const auto [first, is_new] = first_there_.try_emplace({static_cast<double>(magnitude), at.x(), at.y(), at.z()}, k);
    if (!is_new) parent_[root(k)] = root(first->second);
  }

 private:
  std::vector<std::size_t> parent_;
  std::map<std::array<double, 4>, std::size_t> first_there_;
};

double flux_of_all(const LightSet& lights) {
  double sum = 0;
  for (std::uint32_t l = 0; l < lights.size(); ++l) sum += lights[l].flux().max();
  return sum;
}

void add_surfaces(const scene::Scene& scene, double flux_of_all, ByMagnitude& to) {
  const auto exitance = [&](std::size_t k) {
    return scene.materials[scene.surfaces[k].material.value].exitance_of(scene::Side::front);
  };
  Joined joined(scene.surfaces.size());
  for (const scene::Facet& facet : scene.facets)
    if (const Spectrum of = exitance(facet.surface.value); !of.is_zero())
      for (const Vec3& corner : facet.corner) joined.add_corner(facet.surface.value, magnitude_of(of), corner);

  std::map<std::size_t, std::pair<Spectrum, Lamp>> lamps;  // by root: in the order of surfaces
  for (const scene::Facet& facet : scene.facets) {
    const std::size_t k = facet.surface.value;
    const Spectrum of = exitance(k);
    if (of.is_zero() || !(facet.area > 0)) continue;
    auto& [brightest, lamp] =
        lamps.try_emplace(joined.root(k), of, Lamp{scene.surfaces[k].name, {}, 0, 0}).first->second;
    brightest = max(brightest, of);
    for (const Vec3& corner : facet.corner) lamp.box.extend(corner);
    lamp.area += facet.area;
    lamp.picked += facet.area * of.max() / flux_of_all;
  }
  for (const auto& [root, of] : lamps) add(to, of.first, Spectrum(infinite), of.second);
}

void add_balls(const scene::Scene& scene, double flux_of_all, ByMagnitude& to) {
  for (const scene::SphereLight& ball : scene.lights.spheres) {
    if (ball.exitance.is_zero()) continue;
    const Vec3 reach = Vec3::Constant(ball.radius);
    const double disk = pi * ball.radius * ball.radius;
    add(to, ball.exitance, Spectrum(infinite),
        {ball.name, {ball.centre - reach, ball.centre + reach}, disk, 4 * disk * ball.exitance.max() / flux_of_all});
  }
}

}  // namespace

std::vector<AlikeLamps> lamps_nearby(const scene::Scene& scene, const LightSet& lights) {
  ByMagnitude found;
  const double all = flux_of_all(lights);
  add_surfaces(scene, all, found);
  add_balls(scene, all, found);
  return listed(found);
}

std::vector<AlikeLamps> suns_with_angle(const scene::Scene& scene, const LightSet& lights) {
  ByMagnitude found;
  const double all = flux_of_all(lights);
  std::uint32_t l = lights.first_infinite();  // suns come first, those that shine
  for (const scene::Sun& sun : scene.lights.suns) {
    if (sun.irradiance.is_zero()) continue;
    const double flux = lights[l++].flux().max();
    if (sun.one_minus_cosine() > 0)
      add(found, pi * sun.radiance(), sun.irradiance, {sun.name, {}, pi * sun.squared_sine(), flux / all});
  }
  return listed(found);
}

}  // namespace interflect::montecarlo

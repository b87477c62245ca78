#include "montecarlo/lamps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace interflect::montecarlo {
namespace {

constexpr std::size_t most_lamps = 100;

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
class Corners {
 public:
  explicit Corners(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }
  std::size_t root(std::size_t k) {
    while (parent_[k] != k) k = parent_[k] = parent_[parent_[k]];
    return k;
  }
  void add(std::size_t k, int magnitude, const Vec3& at) {
    const auto [first, is_new] = first_there_.try_emplace({static_cast<double>(magnitude), at.x(), at.y(), at.z()}, k);
    if (!is_new) parent_[root(k)] = root(first->second);
  }

 private:
  std::vector<std::size_t> parent_;
  std::map<std::array<double, 4>, std::size_t> first_there_;
};

/// Surfaces that hang together.
struct Lit {
  Spectrum brightest{};
  Vec3 vector_area = Vec3::Zero();
  Lamp lamp{{}, {}, 0, 0};
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
  Corners corners(scene.surfaces.size());
  for (const scene::Facet& facet : scene.facets)
    if (const Spectrum of = exitance(facet.surface.value); !of.is_zero())
      for (const Vec3& corner : facet.corner) corners.add(facet.surface.value, magnitude_of(of), corner);

  std::map<std::size_t, Lit> lit;  // by root: in the order of surfaces
  for (const scene::Facet& facet : scene.facets) {
    const std::size_t k = facet.surface.value;
    const Spectrum of = exitance(k);
    if (of.is_zero() || !(facet.area > 0)) continue;
    Lit& by = lit[corners.root(k)];
    if (by.lamp.name.empty()) by.lamp.name = scene.surfaces[k].name;
    by.brightest = max(by.brightest, of);
    by.vector_area += facet.area * facet.normal;
    by.lamp.area += facet.area;
    by.lamp.picked += facet.area * of.max() / flux_of_all;
    for (const Vec3& corner : facet.corner) by.lamp.box.extend(corner);
  }
  for (auto& [root, by] : lit) {
    by.lamp.area = std::max(by.vector_area.norm(), by.lamp.area / 4);  // of what is flat; of what is round [Cauchy]
    add(to, by.brightest, Spectrum(infinite), by.lamp);
  }
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

/// The sun in a picture of the sky, or whatever there shines most.
void add_brightest(const scene::EnvironmentMap& map, double picked, ByMagnitude& to) {
  double most = 0;
  Spectrum all{}, brightest{}, arriving{};
  for (int r = 0; r < map.rows(); ++r)
    for (int c = 0; c < map.columns(); ++c)
      most = std::max(most, map.texel(r, c).max()), all += map.solid_angle(r) * map.texel(r, c);
  double solid_angle = 0;
  for (int r = 0; r < map.rows(); ++r)
    for (int c = 0; c < map.columns(); ++c)
      if (const Spectrum radiance = map.texel(r, c); radiance.max() >= most / 2) {
        brightest = max(brightest, radiance);
        arriving += map.solid_angle(r) * radiance;
        solid_angle += map.solid_angle(r);
      }
  add(to, pi * brightest, arriving, {"the environment map", {}, solid_angle, picked * arriving.max() / all.max()});
}

}  // namespace

std::vector<AlikeLamps> lamps_nearby(const scene::Scene& scene, const LightSet& lights) {
  ByMagnitude found;
  const double all = flux_of_all(lights);
  add_surfaces(scene, all, found);
  add_balls(scene, all, found);
  return listed(found);
}

std::vector<AlikeLamps> lamps_afar(const scene::Scene& scene, const LightSet& lights) {
  ByMagnitude found;
  const double all = flux_of_all(lights);
  std::uint32_t l = lights.first_infinite();  // suns come first, those that shine
  for (const scene::Sun& sun : scene.lights.suns) {
    if (sun.irradiance.is_zero()) continue;
    const double flux = lights[l++].flux().max();
    if (sun.one_minus_cosine() > 0)
      add(found, pi * sun.radiance(), sun.irradiance, {sun.name, {}, pi * sun.squared_sine(), flux / all});
  }
  if (const auto* map = std::get_if<scene::EnvironmentMap>(&scene.lights.sky); map != nullptr && l < lights.size())
    add_brightest(*map, lights[l].flux().max() / all, found);
  return listed(found);
}

}  // namespace interflect::montecarlo

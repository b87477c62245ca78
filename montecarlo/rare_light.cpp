#include "montecarlo/rare_light.h"

#include <algorithm>
#include <cmath>

#include "core/format.h"
#include "montecarlo/bsdf/of_material.h"
#include "montecarlo/scene_paths.h"

namespace interflect::montecarlo {
namespace {

constexpr double often = 0.04;        ///< what so many paths meet is not rare
constexpr double rule_of_three = 3;   ///< finds to be expected at most, with 95 %, where there was none
constexpr double enough_finds = 100;  ///< to be met

/// Part of all paths that are caught where a surface scatters light from one way; 0 of a mirror, 1 where it has no lobe.
double lobe_of(const scene::Material& material) {
  const Scatters by_this = scatters_of(material);
  if (by_this.specular) return 0;
  if (!by_this.glossy) return 1;
  const auto* metal = std::get_if<scene::Metal>(&material.finish);
  const auto* glass = std::get_if<scene::Glass>(&material.finish);
  const double alpha = metal != nullptr ? metal->roughness : glass != nullptr ? glass->roughness : 0;
  return std::min(1.0, 4 * alpha * alpha);
}

double farthest(const geometry::Box& box, const Vec3& from) {
  return (box.max() - from).cwiseAbs().cwiseMax((box.min() - from).cwiseAbs()).norm();
}

}  // namespace

RareLights::RareLights(const scene::Scene& scene, const LightSet& lights, const measure::PathClasses& paths,
                       NextEvent next_event)
    : scene_(scene), by_mirrors_(next_event == NextEvent::yes) {
  set_smooth();
  if (!by_mirrors_) images_ += 1;  // and the light itself
  const measure::PathClasses there = paths_in(scene) & paths;
  if (there.empty() || (by_mirrors_ && lobe_ >= often)) return;
  add(lamps_nearby(scene, lights), 'A', there);
  add(suns_with_angle(scene, lights), 'F', there);
}

void RareLights::set_smooth() {
  for (const scene::Facet& facet : scene_.facets) {
    const scene::Surface& surface = scene_.surface(facet.surface);
    const double lobe = lobe_of(scene_.material(facet.surface));
    if (lobe >= often) continue;
    lobe_ = std::min(lobe_, lobe);
    images_ += surface.outline ? 1.0 / surface.facets : 1;
    for (const Vec3& corner : facet.corner) smooth_.extend(corner);
  }
}

/// Those that paths bring by chance alone: to a place by way of what is smooth, to a pixel where the path has scattered
/// before that.
void RareLights::add(std::vector<AlikeLamps> lamps, char letter, const measure::PathClasses& there) {
  const auto may_be = [&](const char* way) {
    return !(there & measure::PathClasses::of(std::string(1, letter) + way)).empty();
  };
  const char* smooth = lobe_ > 0 ? "(S|G)" : "S";
  const bool to_places = may_be(by_mirrors_ ? core::format("%s.*E", smooth).c_str() : ".*E"),
             to_pixels = may_be(by_mirrors_ ? core::format("%s.*(D|G).*E", smooth).c_str() : ".*(D|G).*E");
  if (!to_places && !to_pixels) return;
  for (AlikeLamps& each : lamps) lights_.push_back({std::move(each), to_places, to_pixels});
}

/// Paths are as long as from the lamp to what is measured by way of what is smooth, or as the scene is large.
double RareLights::met(const Lamp& lamp, const From& from) const {
  double length = 1;
  if (!lamp.box.isEmpty()) {
    const Vec3 centre = lamp.box.center();
    length = farthest(from.box, centre) + (by_mirrors_ ? 2 * farthest(smooth_, centre) : 0);
    length = std::min(length, scene_.box().diagonal().norm() / 2);
  }
  return std::min(1.0, lamp.area / (pi * length * length));
}

RareLights::Chance RareLights::chance(const RareLight& light, const From& from) const {
  Chance least{nullptr, 1, 0};
  for (const Lamp& lamp : light.of.lamps) {
    const double by_chance = met(lamp, from), in_lobe = by_mirrors_ ? std::max(by_chance, lobe_) : by_chance,
                 found = std::max(in_lobe, from.by_walks * lamp.picked);
    least.share = std::max(least.share, by_chance / found);
    if (least.of == nullptr || found < least.found) least.of = &lamp, least.found = found;
  }
  return least;
}

Spectrum RareLights::lacks(const RareLight& light, double samples, const From& from) const {
  if (!light.comes_to(from)) return Spectrum::zero();
  const Chance of = chance(light, from);
  if (of.found >= often || samples >= enough_finds / of.found) return Spectrum::zero();
  Spectrum lacked = light.of.pi_radiance * (of.share * std::min(rule_of_three / samples, 1.0));
  for (int c = 0; c < Spectrum::capacity; ++c) lacked[c] = std::min(lacked[c], light.of.arriving[c] * images_);
  return lacked;
}

Spectrum RareLights::lacks(std::uint64_t samples, const From& from) const {
  Spectrum squares;
  for (const RareLight& light : lights_) {
    const Spectrum of_this = lacks(light, static_cast<double>(samples), from);
    squares += of_this * of_this;
  }
  return sqrt(squares);
}

double RareLights::samples_for(double wanted, const From& from) const {
  if (empty()) return 0;
  const double of_each = wanted / std::sqrt(static_cast<double>(lights_.size()));
  double samples = 0;
  for (const RareLight& light : lights_) {
    if (!light.comes_to(from) || scene_.weigh(light.of.arriving * images_) <= of_each) continue;
    const Chance of = chance(light, from);
    if (of.found >= often) continue;
    const double find = scene_.weigh(light.of.pi_radiance) * of.share;
    samples = std::max(samples, std::min(rule_of_three * find / of_each, enough_finds / of.found));
  }
  return samples;
}

void RareLights::add_to(Estimate& estimate, double scale, const From& from, SampleReport& report) const {
  const Spectrum lacked = scale * lacks(estimate.samples, from);
  if (lacked.is_zero()) return;
  for (int c = 0; c < Spectrum::capacity; ++c)
    estimate.standard_error[c] = std::hypot(estimate.standard_error[c], lacked[c]);
  const double weighed = scene_.weigh(lacked), known = estimate.weighed_standard_error;
  estimate.weighed_standard_error = std::hypot(known, weighed);
  if (known > weighed || (!report.rare.empty() && report.rare_samples <= estimate.samples)) return;
  report.rare = text(estimate.samples, from);
  report.rare_samples = estimate.samples;
}

/// "light of sun by way of mirrors or smooth glass is met by one path in 46223 or so, and 4096 were taken: .."; of what
/// may be lacked most.
std::string RareLights::text(std::uint64_t samples, const From& from) const {
  const auto lacked = [&](const RareLight& light) {
    return scene_.weigh(lacks(light, static_cast<double>(samples), from));
  };
  const Chance of = chance(*std::ranges::max_element(lights_, {}, lacked), from);
  return core::format(
      "light of %s%s is met by one path in %.0f or so, and %llu were taken: errors allow for some that none has met",
      of.of->name.c_str(), by_mirrors_ ? " by way of mirrors or smooth glass" : "", 1 / of.found,
      static_cast<unsigned long long>(samples));
}

}  // namespace interflect::montecarlo

#include "montecarlo/rare_light.h"

#include <algorithm>
#include <cmath>

#include "core/format.h"
#include "montecarlo/bsdf/of_material.h"
#include "montecarlo/scene_paths.h"

namespace interflect::montecarlo {
namespace {

constexpr double often = 0.01;        ///< what so many paths meet is not rare
constexpr double rule_of_three = 3;   ///< finds to be expected at most, with 95 %, where there was none
constexpr double enough_finds = 100;  ///< to be met

double squared(double x) { return x * x; }

/// Half angle of what rough glass makes of one way, over the half angle alpha of its facets: where it bends light least.
double bent_by(double index) { return std::min(std::abs(index - 1), std::abs(1 - 1 / index)); }

/// Part of all paths, about, that are caught where a surface throws light from one way: 0 of a mirror, 1 of what has no
/// lobe.  Facets of half angle alpha turn what they mirror twice as far: 4 alpha².
double lobe_of(const scene::Material& material) {
  const Scatters by_this = scatters_of(material);
  if (by_this.specular) return 0;
  if (!by_this.glossy) return 1;
  if (const auto* metal = std::get_if<scene::Metal>(&material.finish))
    return std::min(1.0, squared(2 * metal->roughness));
  if (const auto* glass = std::get_if<scene::Glass>(&material.finish))
    return std::min(1.0, squared(bent_by(glass->index) * glass->roughness));
  return 0;
}

/// Root mean square of the distance between points of two boxes.
double apart(const geometry::Box& a, const geometry::Box& b) {
  const auto spread = [](const geometry::Box& box) { return (box.diagonal() / 2).squaredNorm() / 3; };
  return std::sqrt((a.center() - b.center()).squaredNorm() + spread(a) + spread(b));
}

}  // namespace

RareLights::RareLights(const scene::Scene& scene, const LightSet& lights, const measure::PathClasses& paths,
                       NextEvent next_event)
    : scene_(scene), by_mirrors_(next_event == NextEvent::yes), section_(lights.section()) {
  set_smooth();
  if (!by_mirrors_) images_ += 1;  // and the light itself
  const measure::PathClasses there = paths_in(scene) & paths;
  if (there.empty() || (by_mirrors_ && lobe_ >= often)) return;
  add(lamps_nearby(scene, lights), 'A', there);
  add(lamps_afar(scene, lights), 'F', there);
}

bool RareLights::throws_narrowly(const scene::Material& material) { return lobe_of(material) < often; }

void RareLights::set_smooth() {
  for (const scene::Facet& facet : scene_.facets) {
    const scene::Surface& surface = scene_.surface(facet.surface);
    const double lobe = lobe_of(scene_.material(facet.surface));
    if (lobe >= often) continue;
    lobe_ = std::min(lobe_, lobe);
    (lobe > 0 ? lobes_ : mirrors_) = true;
    smooth_area_ += facet.area;
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
  const char* smooth = lobes_ ? (mirrors_ ? "(S|G)" : "G") : "S";
  const bool to_places = may_be(by_mirrors_ ? core::format("%s.*E", smooth).c_str() : ".*E"),
             to_pixels = may_be(by_mirrors_ ? core::format("%s.*(D|G).*E", smooth).c_str() : ".*(D|G).*E");
  if (!to_places && !to_pixels) return;
  for (AlikeLamps& each : lamps) lights_.push_back({std::move(each), to_places, to_pixels});
}

/// By paths from what is measured, by way of what is smooth if that is how they find it.
double RareLights::met(const Lamp& lamp, const From& from) const {
  if (lamp.box.isEmpty()) return std::min(1.0, lamp.area / pi);
  const double length = by_mirrors_ ? apart(from.box, smooth_) + apart(smooth_, lamp.box) : apart(from.box, lamp.box);
  return std::min(1.0, lamp.area / (pi * length * length));
}

/// A walk from a light meets what is smooth by its share of what walks from afar cover.
double RareLights::walks_meet(const From& from) const {
  return std::min(1.0, smooth_area_ / section_) * from.walked_to;
}

RareLights::Chance RareLights::chance(const RareLight& light, const From& from) const {
  Chance least{nullptr, 1, 0};
  const double by_walks = walks_meet(from);
  for (const Lamp& lamp : light.of.lamps) {
    const double by_chance = met(lamp, from), in_lobe = by_mirrors_ ? std::max(by_chance, lobe_) : by_chance,
                 found = std::max(in_lobe, by_walks * lamp.picked);
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

void RareLights::add_to(Estimate& estimate, double scale, const From& from, std::size_t m, SampleReport& report) const {
  const Spectrum lacked = scale * lacks(estimate.samples, from);
  if (lacked.is_zero()) return;
  for (int c = 0; c < Spectrum::capacity; ++c)
    estimate.standard_error[c] = std::hypot(estimate.standard_error[c], lacked[c]);
  const double weighed = scene_.weigh(lacked), known = estimate.weighed_standard_error;
  estimate.weighed_standard_error = std::hypot(known, weighed);
  if (known > weighed || (!report.rare.empty() && report.rare_samples <= estimate.samples)) return;
  report.rare = text(estimate.samples, from, ": errors allow for some that none has met");
  report.rare_samples = estimate.samples;
  report.rare_measurement = m;
}

std::string RareLights::of_picture(std::uint64_t samples) const {
  const From from{scene_.box(), true};
  if (lacks(samples, from).is_zero()) return {};
  return text(samples, from, " a pixel: specks where it is met, and elsewhere errors that do not know of it");
}

/// "light of sun by way of mirrors, glass or metal is met by one path in 46223 or so, and 4096 were taken: .."; of what
/// may be lacked most.
std::string RareLights::text(std::uint64_t samples, const From& from, const char* ending) const {
  const auto lacked = [&](const RareLight& light) {
    return scene_.weigh(lacks(light, static_cast<double>(samples), from));
  };
  const Chance of = chance(*std::ranges::max_element(lights_, {}, lacked), from);
  return core::format("light of %s%s is met by one path in %.0f or so, and %llu were taken%s", of.of->name.c_str(),
                      by_mirrors_ ? " by way of mirrors, glass or metal" : "", 1 / of.found,
                      static_cast<unsigned long long>(samples), ending);
}

}  // namespace interflect::montecarlo

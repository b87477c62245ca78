#include "montecarlo/light_paths.h"

#include <algorithm>
#include <cmath>

#include "montecarlo/roulette.h"
#include "montecarlo/warp.h"

namespace interflect::montecarlo {
namespace {

/// Dimensions: the light and how its light leaves, then what is joined with that; then a vertex after the other.
constexpr std::uint32_t emission_block = 0, first_vertex_block = 6, blocks_per_vertex = 6;

}  // namespace

/// To one of the points and one pixel's camera, each drawn evenly.
template <class Sends>
void LightPaths::join(const Vec3& y, const Vec3& normal, std::optional<std::uint32_t> light, const Sends& sends,
                      bool points, const std::array<double, 4>& u, Deposits& deposits) const {
  const auto towards = [&](const Vec3& way) { return normal.dot(way) >= 0 ? normal : Vec3(-normal); };
  if (const auto all = targets_.points(); points && !all.empty()) {
    const auto& point = all[std::min(all.size() - 1, static_cast<std::size_t>(u[0] * static_cast<double>(all.size())))];
    const Vec3 way = point.position - y;
    const double square = way.squaredNorm(), r = std::sqrt(square), cos_x = -point.normal.dot(way) / r;
    if (cos_x > 0) {
      const Spectrum sent = sends(Vec3(way / r));
      if (!sent.is_zero())
        deposits.add(point.measurement, sent * sight_.let_pass({y, point.position, towards(way), point.normal}, light) *
                                            (cos_x / square * static_cast<double>(all.size())));
    }
  }
  if (const auto all = targets_.films(); !all.empty()) {
    const auto& film = all[std::min(all.size() - 1, static_cast<std::size_t>(u[1] * static_cast<double>(all.size())))];
    const auto image = film.map.image_of(y, scene::uniform_disk(u[2], u[3]));
    if (!image || !film.counts(image->film)) return;
    const Spectrum sent = sends(Vec3(-image->ray.direction));
    if (sent.is_zero()) return;
    const Spectrum arrives = sent * sight_.let_pass({y, image->ray.origin, towards(-image->ray.direction)}, light) *
                             (image->pdf_area * static_cast<double>(all.size()));
    film.visit(image->film, [&](std::uint32_t measurement, double h) { deposits.add(measurement, h * arrives); });
  }
}

void LightPaths::join_emission(std::uint32_t light, const Emission& emission, double probability,
                               core::RandomNumbers& numbers, Deposits& deposits) const {
  const double pick = numbers.next(), which = numbers.next(), u = numbers.next(), v = numbers.next(),
               film = numbers.next(), lens_u = numbers.next(), lens_v = numbers.next();
  // Points draw from their own place what arrives there: from a place on the light it would vary without end.
  if (const auto all = targets_.points(); !all.empty()) {
    const auto& point =
        all[std::min(all.size() - 1, static_cast<std::size_t>(which * static_cast<double>(all.size())))];
    const Place place{point.position, point.normal};
    const auto [picked, chance] = lights_.pick(place, pick);
    const auto arriving =
        chance > 0 && counts_straight_from(picked) ? lights_[picked].sample_arriving(place, u, v) : std::nullopt;
    const double cosine = arriving ? point.normal.dot(arriving->way) : 0;
    if (cosine > 0) {
      const Vec3 from =
          std::isfinite(arriving->distance) ? arriving->position : lights_.beyond(point.position, arriving->way);
      const double pdf = arriving->pdf_solid_angle > 0 ? arriving->pdf_solid_angle : 1;
      deposits.add(point.measurement,
                   arriving->light * sight_.let_pass({point.position, from, point.normal, arriving->normal}, picked) *
                       (cosine / (pdf * chance) * static_cast<double>(all.size())));
    }
  }
  if (emission.normal.isZero() || !counts_straight_from(light)) return;  // a point's own picture is nothing
  const auto sends = [&](const Vec3& way) {
    const double cosine = emission.normal.dot(way);
    return cosine > 0 ? lights_[light].radiance(emission.position, way) * (cosine / (emission.pdf_area * probability))
                      : Spectrum::zero();
  };
  join(emission.position, emission.normal, light, sends, false, {0, film, lens_u, lens_v}, deposits);
}

void LightPaths::join_scattering(const Arrived& arrived, const Bsdf& bsdf, core::RandomNumbers& numbers,
                                 Deposits& deposits) const {
  if (targets_.empty() || bsdf.only_delta() || !counts(paths_.after(arrived.letters, letter_of(bsdf)))) return;
  std::array<double, 4> u;
  for (double& each : u) each = numbers.next();
  const auto sends = [&](const Vec3& way) {
    const Vec3 to = arrived.frame.to_local(way);
    return arrived.flux * bsdf.f(arrived.from, to) * std::abs(to.z());
  };
  join(arrived.at.position, arrived.frame.n, std::nullopt, sends, true, u, deposits);
}

void LightPaths::trace(core::RandomNumbers& numbers, Deposits& deposits) const {
  numbers.jump(emission_block);
  const auto [light, probability] = emissions_.pick(numbers.next());
  std::array<double, 4> u;
  for (double& each : u) each = numbers.next();
  const Emission emission = lights_[light].sample_emission(u);
  Spectrum flux = emission.weight / probability;
  if (!targets_.empty()) join_emission(light, emission, probability, numbers, deposits);
  const double at_first = flux.max();
  if (flux.is_zero()) return;  // and not where it is no number
  const bool from_afar = lights_[light].is_infinite();
  raycast::Ray ray{emission.position, emission.way, from_afar ? Vec3(Vec3::Zero()) : emission.normal};
  std::optional<std::uint32_t> leaves = light;
  std::vector<MeasuredPatches::Share> shares;
  Letters letters = paths_.after(paths_.before_light(), letter_of(lights_[light]));
  for (std::uint32_t block = first_vertex_block;; block += blocks_per_vertex) {
    const auto hit = sight_.met(ray, std::exchange(leaves, std::nullopt)).surface;
    if (!hit) return;
    if (counts(letters))
      patches_.at(*hit, shares);
    else
      shares.clear();
    for (const auto& [measurement, per_flux] : shares) deposits.add(measurement, flux * per_flux);
    const Bsdf* bsdf = optics_.bsdf(hit->surface);
    if (bsdf == nullptr) return;
    const Frame frame = frame_around(front_normal(*hit));
    const Vec3 from = frame.to_local(-ray.direction);
    numbers.jump(block);
    const double lobe = numbers.next(), a = numbers.next(), b = numbers.next(), survival = numbers.next();
    join_scattering({*hit, frame, from, flux, letters}, *bsdf, numbers, deposits);
    const auto on = bsdf->sample(from, {lobe, a, b}, Walk::from_light);
    if (!on) return;
    flux *= on->weight;
    const double survives = going_on(flux.max() / at_first);
    if (!(survival < survives)) return;
    flux /= survives;
    if (!on->straight) letters = paths_.after(letters, letter_of(*bsdf, *on));
    ray = {hit->position, frame.to_world(on->way), on->way.z() >= 0 ? frame.n : Vec3(-frame.n)};
  }
}

}  // namespace interflect::montecarlo

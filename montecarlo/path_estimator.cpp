#include "montecarlo/path_estimator.h"

#include <algorithm>

#include "montecarlo/roulette.h"
#include "montecarlo/scene_paths.h"
#include "montecarlo/warp.h"

namespace interflect::montecarlo {

namespace {

/// The side of a surface that a direction leads to.
Vec3 normal_towards(const Vec3& front, double z) { return z >= 0 ? front : Vec3(-front); }

}  // namespace

PathEstimator::PathEstimator(const scene::Scene& scene, const raycast::RayCaster& caster,
                             const measure::PathClasses& paths, NextEvent next_event)
    : scene_(scene),
      paths_(paths),
      all_paths_(paths == measure::PathClasses::all()),
      next_event_(next_event == NextEvent::yes),
      lights_(scene),
      optics_(scene),
      sight_(caster, lights_, optics_),
      largest_score_(2 * lights_.largest_find()) {
  if (!next_event_) largest_score_ = max(largest_score_, lights_.brightest());
}

PathEstimator::Carried PathEstimator::from_eye() const {
  Carried path;
  path.letters = paths_.after(paths_.before_eye(), measure::PathLetter::eye);
  return path;
}

Spectrum PathEstimator::irradiance(const Receiver& at, core::RandomNumbers& numbers, std::uint32_t block) const {
  Carried path = from_eye();
  follow(receiving(at), path, numbers, block);
  return path.found * pi;
}

Spectrum PathEstimator::radiance(const Vec3& eye, const Vec3& direction, core::RandomNumbers& numbers,
                                 std::uint32_t block) const {
  Carried path = from_eye();
  const Drawn drawn{{eye, direction}, {eye, Vec3::Zero()}, 0};
  if (Vertex at{}; arrive(drawn, sight_.caster().closest(drawn.ray), path, at)) follow(at, path, numbers, block);
  return path.found;
}

void PathEstimator::follow(Vertex at, Carried& path, core::RandomNumbers& numbers, std::uint32_t block) const {
  Drawn drawn{{}, {}, 0};
  for (;; block += blocks_per_vertex) {
    numbers.jump(block);
    Numbers drawn_here;
    for (double* each : {&drawn_here.on_u, &drawn_here.on_v, &drawn_here.u, &drawn_here.v, &drawn_here.pick,
                         &drawn_here.survival, &drawn_here.lobe})
      *each = numbers.next();
    const Place place = place_of(at);
    if (const auto light = from_lights(at, path, place, drawn_here.pick, drawn_here.on_u, drawn_here.on_v))
      path.found += path.throughput * (sight_.let_pass(light->segment, light->of) * light->light);
    if (!goes_on(at, place, drawn_here, path, drawn)) return;
    if (!arrive(drawn, sight_.caster().closest(drawn.ray), path, at)) return;
  }
}

bool PathEstimator::goes_on(const Vertex& at, const Place& place, const Numbers& numbers, Carried& path, Drawn& drawn,
                            bool for_sure) const {
  const auto on = at.bsdf->sample(at.to_eye, {numbers.lobe, numbers.u, numbers.v}, Walk::from_eye);
  if (!on) return false;
  path.throughput *= on->weight;
  path.squeezed *= on->squeezed;
  const double survives = for_sure ? 1 : going_on(path.throughput.max() / path.squeezed);
  if (!(numbers.survival < survives)) return false;
  path.throughput /= survives;
  drawn.ray = {at.position, at.frame.to_world(on->way), normal_towards(at.frame.n, on->way.z())};
  if (on->straight) return true;
  drawn.from = place, drawn.pdf_solid_angle = on->pdf_solid_angle;
  if (!all_paths_ && !at.receives) path.letters = paths_.after(path.letters, letter_of(*at.bsdf, *on));
  return !measure::PathClasses::hopeless(path.letters);
}

/// Finds what shines there.
/// @param hit  the surface that the ray meets
/// @param at   where it scatters there
/// @return     whether a path goes on
bool PathEstimator::arrive(const Drawn& drawn, const std::optional<scene::SurfacePoint>& hit, Carried& path,
                           Vertex& at) const {
  if (const auto ball = sight_.ball_before(drawn.ray, hit)) {
    if (ends_at(path, measure::PathLetter::area))
      path.found += path.throughput * shines(lights_.of_ball(ball->ball), drawn, ball->position);
    return false;
  }
  if (!hit) {
    path.found += path.throughput * escaped(drawn, path);
    return false;
  }
  path.found += path.throughput * emitted(drawn, path, *hit);
  const Bsdf* bsdf = optics_.bsdf(hit->surface);
  if (bsdf == nullptr) return false;
  at.position = hit->position;
  at.frame = frame_around(front_normal(*hit));
  at.to_eye = at.frame.to_local(-drawn.ray.direction);
  at.bsdf = bsdf;
  at.receives = false;
  return true;
}

Place PathEstimator::place_of(const Vertex& at) {
  return {at.position, at.bsdf->transmits() ? Vec3(Vec3::Zero()) : normal_towards(at.frame.n, at.to_eye.z())};
}

std::optional<PathEstimator::Candidate> PathEstimator::from_lights(const Vertex& at, const Carried& path,
                                                                   const Place& place, double pick, double u,
                                                                   double v) const {
  if (!next_event_ || at.bsdf->only_delta() || lights_.empty()) return std::nullopt;
  const auto [index, probability] = lights_.pick(place, pick);
  const Light& light = lights_[index];
  if (!all_paths_ && !measure::PathClasses::complete(paths_.after(with_letter(path, at), letter_of(light))))
    return std::nullopt;
  const std::optional<Arriving> y = light.sample_arriving(place, u, v);
  if (!y) return std::nullopt;
  const Vec3 local = at.frame.to_local(y->way);
  const Spectrum f = at.bsdf->f(local, at.to_eye);
  if (f.is_zero()) return std::nullopt;
  const Vec3 end = light.is_infinite() ? lights_.beyond(at.position, y->way) : y->position;
  const double both =
      light.is_delta() ? probability : probability * y->pdf_solid_angle + at.bsdf->pdf_solid_angle(at.to_eye, local);
  return Candidate{f * y->light * (std::abs(local.z()) / both),
                   {at.position, end, normal_towards(at.frame.n, local.z()), y->normal},
                   index};
}

Spectrum PathEstimator::emitted(const Drawn& drawn, const Carried& path, const scene::SurfacePoint& hit) const {
  const Spectrum& exitance = optics_.exitance(hit);
  if (exitance.is_zero() || !ends_at(path, measure::PathLetter::area)) return Spectrum::zero();
  const auto light = lights_.of_facet(hit.facet);
  return light ? shines(*light, drawn, hit.position) : exitance * inv_pi;
}

/// From afar.
Spectrum PathEstimator::escaped(const Drawn& drawn, const Carried& path) const {
  if (!ends_at(path, measure::PathLetter::far)) return Spectrum::zero();
  Spectrum sum;
  for (std::uint32_t l = lights_.first_infinite(); l < lights_.size(); ++l) sum += shines(l, drawn, Vec3::Zero());
  return sum;
}

/// What the ray finds of a light that it meets there.
Spectrum PathEstimator::shines(std::uint32_t light, const Drawn& drawn, const Vec3& from) const {
  const Vec3& way = drawn.ray.direction;
  const Spectrum radiance = lights_[light].radiance(from, -way);
  if (!next_event_ || radiance.is_zero() || drawn.pdf_solid_angle == 0) return radiance;
  const double by_light =
      lights_.probability(light, drawn.from) * lights_[light].pdf_arriving_solid_angle(drawn.from, way, from);
  return radiance * (drawn.pdf_solid_angle / (drawn.pdf_solid_angle + by_light));
}

}  // namespace interflect::montecarlo

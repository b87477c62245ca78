#include "montecarlo/path_estimator.h"

#include <algorithm>

#include "montecarlo/roulette.h"
#include "montecarlo/warp.h"

namespace interflect::montecarlo {

namespace {

/// Light 1, point on it 2, direction 3, survival 1, and one that is left.
constexpr std::uint32_t blocks_per_vertex = 4;

/// The side of a surface that a direction leads to.
Vec3 normal_towards(const Vec3& front, double z) { return z >= 0 ? front : Vec3(-front); }

}  // namespace

PathEstimator::PathEstimator(const scene::Scene& scene, const raycast::RayCaster& caster,
                             const measure::PathClasses& paths)
    : scene_(scene),
      paths_(paths),
      all_paths_(paths == measure::PathClasses::all()),
      lights_(scene),
      optics_(scene),
      sight_(caster, lights_, optics_) {}

PathEstimator::Carried PathEstimator::from_eye() const {
  Carried path;
  path.letters = paths_.after(paths_.before_eye(), measure::PathLetter::eye);
  return path;
}

Spectrum PathEstimator::irradiance(const Receiver& at, core::RandomNumbers& numbers, std::uint32_t block) const {
  Carried path = from_eye();
  follow({at.position, frame_around(at.normal), Vec3::UnitZ(), &receiver_, true}, path, numbers, block);
  return path.found * pi;
}

Spectrum PathEstimator::radiance(const Vec3& eye, const Vec3& direction, core::RandomNumbers& numbers,
                                 std::uint32_t block) const {
  Carried path = from_eye();
  if (const auto at = arrive({{eye, direction}, {eye, Vec3::Zero()}, 0}, path)) follow(*at, path, numbers, block);
  return path.found;
}

void PathEstimator::follow(Vertex at, Carried& path, core::RandomNumbers& numbers, std::uint32_t block) const {
  Drawn drawn{{}, {}, 0};
  for (;; block += blocks_per_vertex) {
    numbers.jump(block);
    const double u = numbers.next(), v = numbers.next(), pick = numbers.next(), on_u = numbers.next(),
                 on_v = numbers.next(), survival = numbers.next(), lobe = numbers.next();
    const Place place = place_of(at);
    if (!at.bsdf->only_delta()) path.found += path.throughput * from_lights(at, path, place, pick, on_u, on_v);
    const std::optional<Scattered> on = at.bsdf->sample(at.to_eye, {lobe, u, v}, Walk::from_eye);
    if (!on) return;
    path.throughput *= on->weight;
    path.squeezed *= on->squeezed;
    const double survives = going_on(path.throughput.max() / path.squeezed);
    if (!(survival < survives)) return;
    path.throughput /= survives;
    drawn.ray = {at.position, at.frame.to_world(on->way), normal_towards(at.frame.n, on->way.z())};
    if (!on->straight) {
      drawn.from = place, drawn.pdf_solid_angle = on->pdf_solid_angle;
      if (!all_paths_ && !at.receives) path.letters = paths_.after(path.letters, letter_of(*at.bsdf, *on));
      if (measure::PathClasses::hopeless(path.letters)) return;
    }
    const std::optional<Vertex> next = arrive(drawn, path);
    if (!next) return;
    at = *next;
  }
}

/// Finds what shines there.  @return  nothing where no path goes on
std::optional<PathEstimator::Vertex> PathEstimator::arrive(const Drawn& drawn, Carried& path) const {
  const auto [hit, ball] = sight_.met(drawn.ray);
  if (ball) {
    if (ends_at(path, measure::PathLetter::area))
      path.found += path.throughput * shines(lights_.of_ball(ball->ball), drawn, ball->position);
    return std::nullopt;
  }
  if (!hit) {
    path.found += path.throughput * escaped(drawn, path);
    return std::nullopt;
  }
  path.found += path.throughput * emitted(drawn, path, *hit);
  const Bsdf* bsdf = optics_.bsdf(hit->surface);
  if (bsdf == nullptr) return std::nullopt;
  const Frame frame = frame_around(front_normal(*hit));
  return Vertex{hit->position, frame, frame.to_local(-drawn.ray.direction), bsdf};
}

Place PathEstimator::place_of(const Vertex& at) {
  return {at.position, at.bsdf->transmits() ? Vec3(Vec3::Zero()) : normal_towards(at.frame.n, at.to_eye.z())};
}

Spectrum PathEstimator::from_lights(const Vertex& at, const Carried& path, const Place& place, double pick, double u,
                                    double v) const {
  if (lights_.empty()) return Spectrum::zero();
  const auto [index, probability] = lights_.pick(place, pick);
  const Light& light = lights_[index];
  if (!all_paths_ && !measure::PathClasses::complete(paths_.after(with_letter(path, at), letter_of(light))))
    return Spectrum::zero();
  const std::optional<Arriving> y = light.sample_arriving(place, u, v);
  if (!y) return Spectrum::zero();
  const Vec3 local = at.frame.to_local(y->way);
  const Spectrum f = at.bsdf->f(local, at.to_eye);
  if (f.is_zero()) return f;
  const Vec3 end = light.is_infinite() ? lights_.beyond(at.position, y->way) : y->position;
  const Spectrum passes = sight_.let_pass({at.position, end, normal_towards(at.frame.n, local.z()), y->normal}, index);
  const double both =
      light.is_delta() ? probability : probability * y->pdf_solid_angle + at.bsdf->pdf_solid_angle(at.to_eye, local);
  return passes * f * y->light * (std::abs(local.z()) / both);
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
  if (radiance.is_zero() || drawn.pdf_solid_angle == 0) return radiance;
  const double by_light =
      lights_.probability(light, drawn.from) * lights_[light].pdf_arriving_solid_angle(drawn.from, way, from);
  return radiance * (drawn.pdf_solid_angle / (drawn.pdf_solid_angle + by_light));
}

}  // namespace interflect::montecarlo

#include "montecarlo/path_estimator.h"

#include <algorithm>

#include "montecarlo/warp.h"

namespace interflect::montecarlo {

namespace {

/// Emitter 1, point on it 2, direction 3, survival 1, and one that is left.
constexpr std::uint32_t blocks_per_vertex = 4;
constexpr double likeliest = 0.999;  ///< to go on: what loses nothing would not end

/// The side of a surface that a direction leads to.
Vec3 normal_towards(const Vec3& front, double z) { return z >= 0 ? front : Vec3(-front); }

}  // namespace

PathEstimator::PathEstimator(const scene::Scene& scene, const raycast::RayCaster& caster)
    : scene_(scene), caster_(caster), emitters_(scene), optics_(scene) {}

Spectrum PathEstimator::irradiance(const Receiver& at, core::RandomNumbers& numbers, std::uint32_t block) const {
  Carried path;
  follow({at.position, frame_around(at.normal), Vec3::UnitZ(), &receiver_}, path, numbers, block);
  return path.found * pi;
}

Spectrum PathEstimator::radiance(const Vec3& eye, const Vec3& direction, core::RandomNumbers& numbers,
                                 std::uint32_t block) const {
  Carried path;
  if (const auto at = arrive({{eye, direction}, eye, 0}, path)) follow(*at, path, numbers, block);
  return path.found;
}

void PathEstimator::follow(Vertex at, Carried& path, core::RandomNumbers& numbers, std::uint32_t block) const {
  Drawn drawn{{}, at.position, 0};
  for (;; block += blocks_per_vertex) {
    numbers.jump(block);
    const double u = numbers.next(), v = numbers.next(), pick = numbers.next(), on_u = numbers.next(),
                 on_v = numbers.next(), survival = numbers.next(), lobe = numbers.next();
    if (!at.bsdf->only_delta()) path.found += path.throughput * from_emitters(at, pick, on_u, on_v);
    const std::optional<Scattered> on = at.bsdf->sample(at.to_eye, {lobe, u, v}, Walk::from_eye);
    if (!on) return;
    path.throughput *= on->weight;
    path.squeezed *= on->squeezed;
    const double survives = std::min(likeliest, path.throughput.max() / path.squeezed);
    if (!(survival < survives)) return;
    path.throughput /= survives;
    drawn.ray = {at.position, at.frame.to_world(on->way), normal_towards(at.frame.n, on->way.z())};
    if (!on->straight) drawn.from = at.position, drawn.pdf_solid_angle = on->pdf_solid_angle;
    const std::optional<Vertex> next = arrive(drawn, path);
    if (!next) return;
    at = *next;
  }
}

/// Finds what shines there.  @return  nothing where no path goes on
std::optional<PathEstimator::Vertex> PathEstimator::arrive(const Drawn& drawn, Carried& path) const {
  const auto hit = caster_.closest(drawn.ray);
  if (!hit) return std::nullopt;
  path.found += path.throughput * emitted(drawn, *hit);
  const Bsdf* bsdf = optics_.bsdf(hit->surface);
  if (bsdf == nullptr) return std::nullopt;
  const Frame frame = frame_around(front_normal(*hit));
  return Vertex{hit->position, frame, frame.to_local(-drawn.ray.direction), bsdf};
}

Spectrum PathEstimator::from_emitters(const Vertex& at, double pick, double u, double v) const {
  if (emitters_.empty()) return Spectrum::zero();
  const EmitterSample y = emitters_.sample(pick, u, v);
  const Vec3 way = y.position - at.position;
  const double square = way.squaredNorm(), r = std::sqrt(square), cos_y = -y.normal.dot(way) / r;
  if (!(cos_y > 0)) return Spectrum::zero();
  const Vec3 local = at.frame.to_local(way) / r;
  const Spectrum f = at.bsdf->f(local, at.to_eye);
  if (f.is_zero()) return f;
  const Spectrum passes = let_pass({at.position, y.position, normal_towards(at.frame.n, local.z()), y.normal});
  const double both = y.pdf_area * square / cos_y + at.bsdf->pdf_solid_angle(at.to_eye, local);
  return passes * f * y.exitance * (inv_pi * std::abs(local.z()) / both);
}

Spectrum PathEstimator::emitted(const Drawn& drawn, const scene::SurfacePoint& hit) const {
  const Spectrum& exitance = optics_.exitance(hit);
  if (exitance.is_zero()) return exitance;
  if (drawn.pdf_solid_angle == 0) return exitance * inv_pi;
  const double by_emitters =
      emitters_.pdf_area(hit.facet) * (hit.position - drawn.from).squaredNorm() / -drawn.ray.direction.dot(hit.normal);
  return exitance * (inv_pi * drawn.pdf_solid_angle / (drawn.pdf_solid_angle + by_emitters));
}

/// What of light comes from one end to the other, straight through what lets it.
Spectrum PathEstimator::let_pass(const raycast::Segment& segment) const {
  if (!optics_.any_lets_pass()) return caster_.occluded(segment) ? Spectrum::zero() : Spectrum(1);
  raycast::Segment left = segment;
  Spectrum passes(1);
  const Vec3 way = (segment.to - segment.from).normalized();
  while (caster_.occluded(left)) {
    const auto hit = caster_.closest({left.from, way, left.from_normal});
    if (!hit) return Spectrum::zero();  // what blocks is met within rounding alone
    const Bsdf* bsdf = optics_.bsdf(hit->surface);
    if (bsdf == nullptr || !bsdf->lets_pass()) return Spectrum::zero();
    passes *= bsdf->straight(frame_around(front_normal(*hit)).to_local(-way));
    if (passes.is_zero()) return passes;
    left.from = hit->position;
    left.from_normal = -hit->normal;
  }
  return passes;
}

}  // namespace interflect::montecarlo

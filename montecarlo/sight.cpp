#include "montecarlo/sight.h"

#include <limits>

#include "montecarlo/warp.h"

namespace interflect::montecarlo {

Sight::Met Sight::met(const raycast::Ray& ray, std::optional<std::uint32_t> leaves) const {
  Met met{caster_.closest(ray), std::nullopt};
  met.ball = ball_before(ray, met.surface, leaves ? lights_.ball_of(*leaves) : Balls::none);
  if (met.ball) met.surface.reset();
  return met;
}

std::optional<Balls::Hit> Sight::ball_before(const raycast::Ray& ray, const std::optional<scene::SurfacePoint>& surface,
                                             std::uint32_t leaves) const {
  if (lights_.balls().empty()) return std::nullopt;
  const double before = surface ? (surface->position - ray.origin).norm() : std::numeric_limits<double>::infinity();
  return lights_.balls().closest(ray.origin, ray.direction, before, leaves);
}

Spectrum Sight::let_pass(const raycast::Segment& segment, std::optional<std::uint32_t> of) const {
  const Balls& balls = lights_.balls();
  if (!balls.empty() && balls.block(segment.from, segment.to, of ? lights_.ball_of(*of) : Balls::none))
    return Spectrum::zero();
  if (!optics_.any_lets_pass()) return caster_.occluded(segment) ? Spectrum::zero() : Spectrum(1);
  raycast::Segment left = segment;
  Spectrum passes(1);
  const Vec3 way = (segment.to - segment.from).normalized();
  while (caster_.occluded(left)) {
    const auto hit = caster_.closest({left.from, way, left.from_normal});
    // What blocks may be met within rounding alone, of either end.
    if (!hit || !((hit->position - left.to).dot(way) < 0)) return Spectrum::zero();
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

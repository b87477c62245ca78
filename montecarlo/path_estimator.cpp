#include "montecarlo/path_estimator.h"

#include <algorithm>

#include "montecarlo/warp.h"

namespace interflect::montecarlo {

namespace {

constexpr std::uint32_t blocks_per_vertex = 3;  ///< direction 2, emitter 1, point on it 2, survival 1

/// 1 / (1 + pi pdf_area / G): what both techniques score per exitance.
double balanced(double pdf_area, double G) { return 1 / (1 + pi * pdf_area / G); }

}  // namespace

PathEstimator::PathEstimator(const scene::Scene& scene, const raycast::RayCaster& caster)
    : scene_(scene), caster_(caster), emitters_(scene) {
  optics_.reserve(2 * scene.surfaces.size());
  for (const scene::SurfaceId id : scene.surface_ids())
    for (const scene::Side side : {scene::Side::front, scene::Side::back})
      optics_.push_back({scene.material(id).reflectance_of(side), scene.material(id).exitance_of(side)});
}

Spectrum PathEstimator::irradiance(Receiver at, core::RandomNumbers& numbers, std::uint32_t block) const {
  Spectrum found, throughput(1);
  for (;; block += blocks_per_vertex) {
    numbers.jump(block);
    const double u = numbers.next(), v = numbers.next(), pick = numbers.next(), on_u = numbers.next(),
                 on_v = numbers.next();
    found += throughput * from_emitters(at, pick, on_u, on_v);
    const Vec3 local = cosine_hemisphere(u, v), direction = frame_around(at.normal).to_world(local);
    const auto hit = caster_.closest({at.position, direction, at.normal});
    if (!hit) return found;
    found += throughput * from_hit(at, direction, local.z(), *hit);
    throughput *= optics(*hit).reflectance;
    const double survives = std::min(1.0, throughput.max());
    if (numbers.next() >= survives) return found;
    throughput /= survives;
    at = {hit->position, hit->normal};
  }
}

Spectrum PathEstimator::radiance(const Vec3& eye, const Vec3& direction, core::RandomNumbers& numbers,
                                 std::uint32_t block) const {
  const auto hit = caster_.closest({eye, direction});
  if (!hit) return Spectrum::zero();
  const Optics& seen = optics(*hit);
  Spectrum radiosity = seen.exitance;
  if (!seen.reflectance.is_zero())
    radiosity += seen.reflectance * irradiance({hit->position, hit->normal}, numbers, block);
  return radiosity * inv_pi;
}

Spectrum PathEstimator::from_emitters(const Receiver& at, double pick, double u, double v) const {
  if (emitters_.empty()) return Spectrum::zero();
  const EmitterSample y = emitters_.sample(pick, u, v);
  const Vec3 way = y.position - at.position;
  const double cos_x_r = at.normal.dot(way), cos_y_r = -y.normal.dot(way);  // cosines times r
  if (cos_x_r <= 0 || cos_y_r <= 0) return Spectrum::zero();
  if (caster_.occluded({at.position, y.position, at.normal, y.normal})) return Spectrum::zero();
  const double r2 = way.squaredNorm();
  return y.exitance * balanced(y.pdf_area, cos_x_r * cos_y_r / (r2 * r2));
}

Spectrum PathEstimator::from_hit(const Receiver& at, const Vec3& direction, double cos_x,
                                 const scene::SurfacePoint& hit) const {
  const Spectrum& exitance = optics(hit).exitance;
  if (exitance.is_zero()) return Spectrum::zero();
  const double cos_y = -direction.dot(hit.normal);
  return exitance * balanced(emitters_.pdf_area(hit.facet), cos_x * cos_y / (hit.position - at.position).squaredNorm());
}

}  // namespace interflect::montecarlo

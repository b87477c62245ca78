#include "fem/element_rays.h"

#include "scene/diffuse_sides.h"

namespace interflect::fem {

ElementRays::ElementRays(const scene::SurfacePatch& patch) : map_(patch), frame_(core::frame_around(patch.normal())) {}

ElementRay ElementRays::operator()(double s, double t, double u, double v) const {
  const WeightedPoint from = map_(s, t);
  return {{from.position, frame_.to_world(core::cosine_hemisphere(u, v)).normalized(), frame_.n}, from.weight};
}

bool is_lost(const scene::Scene& scene, const std::optional<scene::SurfacePoint>& hit) {
  return !hit || !scene::is_diffuse_side(scene.material(hit->surface), hit->side);
}

}  // namespace interflect::fem

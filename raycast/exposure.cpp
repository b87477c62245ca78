#include "raycast/exposure.h"

#include <algorithm>
#include <cmath>

#include "core/hemisphere.h"
#include "core/random.h"

namespace interflect::raycast {
namespace {

/// A facet of the surface in proportion to its area, for u in [0, 1).
const scene::Facet& pick_facet(const scene::Scene& scene, scene::SurfaceId surface, double u) {
  const auto facets = scene.facets_of(surface);
  double left = u * scene.area(surface);
  for (const scene::Facet& facet : facets)
    if ((left -= facet.area) < 0) return facet;
  return facets.back();
}

Exposure expose(const scene::Scene& scene, const RayCaster& caster, scene::SurfaceId surface, scene::Side side,
                int rays, std::uint64_t seed) {
  int backs = 0, nothing = 0;
  const auto stream = 2 * surface.value + (side == scene::Side::back ? 1 : 0);
  for (int k = 0; k < rays; ++k) {
    core::RandomNumbers numbers(seed, stream, static_cast<std::uint64_t>(k));
    const double pick = numbers.next(), u = numbers.next(), v = numbers.next(), s = numbers.next(), t = numbers.next();
    const scene::Facet& facet = pick_facet(scene, surface, pick);
    const Vec3 normal = side == scene::Side::front ? facet.normal : Vec3(-facet.normal);
    const Vec3 origin = core::triangle_point(facet.corner[0], facet.corner[1], facet.corner[2], u, v);
    const Vec3 direction = core::frame_around(normal).to_world(core::cosine_hemisphere(s, t));
    const auto hit = caster.closest({origin, direction, normal});
    if (!hit)
      ++nothing;
    else if (!scene.material(hit->surface).active(hit->side))
      ++backs;
  }
  const double share = static_cast<double>(backs) / rays;
  return {surface, side, share, static_cast<double>(nothing) / rays, std::sqrt(share * (1 - share) / rays)};
}

}  // namespace

std::vector<Exposure> exposures(const scene::Scene& scene, const RayCaster& caster, int rays, Run& run) {
  std::vector<std::pair<scene::SurfaceId, scene::Side>> sides;
  for (scene::SurfaceId id : scene.surface_ids())
    for (scene::Side side : {scene::Side::front, scene::Side::back})
      if (scene.material(id).active(side)) sides.emplace_back(id, side);
  std::vector<Exposure> found(sides.size());
  const std::uint64_t seed = core::derived_seed(run.seed, "exposure");
  run.threads.for_blocks(static_cast<Index>(sides.size()), 1, [&](Index begin, Index) {
    const auto& [surface, side] = sides[static_cast<std::size_t>(begin)];
    found[static_cast<std::size_t>(begin)] = expose(scene, caster, surface, side, rays, seed);
  });
  return found;
}

}  // namespace interflect::raycast

#include "apps/contacts.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/format.h"
#include "core/log.h"
#include "scene/inspection.h"

namespace interflect::apps {
namespace {

std::optional<scene::SurfaceId> surface_named(const scene::Scene& scene, const std::string& name) {
  for (const scene::SurfaceId id : scene.surface_ids())
    if (scene.surface(id).name == name) return id;
  return std::nullopt;
}

/// Of the facet whose plane the point is in.
Vec3 normal_at(const scene::Scene& scene, scene::SurfaceId id, const Vec3& x) {
  const auto facets = scene.facets_of(id);
  const auto distance = [&](const scene::Facet& facet) { return std::abs(facet.normal.dot(x - facet.corner[0])); };
  return std::min_element(facets.begin(), facets.end(),
                          [&](const scene::Facet& a, const scene::Facet& b) { return distance(a) < distance(b); })
      ->normal;
}

/// Whether the front of a surface looks into something from within: past what lies on it, at a black back.
bool looks_inside(const scene::Scene& scene, const raycast::RayCaster& rays, const std::string& name, const Vec3& x,
                  double step) {
  const auto id = surface_named(scene, name);
  if (!id) return false;
  const Vec3 normal = normal_at(scene, *id, x);
  const auto hit = rays.closest({x + step * normal, normal});
  return hit && !scene.material(hit->surface).active(hit->side);
}

}  // namespace

void warn_of_contacts(const scene::Scene& scene, const raycast::RayCaster& rays) {
  for (const auto& found : scene::overlaps(scene)) {
    const double facing = found.size - found.same_way;
    if (found.other.empty() || !(facing > 0)) continue;
    const double step = std::max(1e-3 * std::sqrt(facing), 2 * rays.offset());
    if (!looks_inside(scene, rays, found.surface, found.where, step) &&
        !looks_inside(scene, rays, found.other, found.where, step))
      continue;
    core::log::warning(core::format(
        "'%s' and '%s' lie on each other over %.3g m2 at (%.6g, %.6g, %.6g): what is covered sees nothing and is not "
        "made "
        "up for; cut it out, and leave out what lies on it",
        found.surface.c_str(), found.other.c_str(), facing, found.where.x(), found.where.y(), found.where.z()));
  }
}

}  // namespace interflect::apps

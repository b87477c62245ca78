#include "raycast/ray_caster.h"

#include <array>

#include "core/error.h"
#include "raycast/casters.h"

namespace interflect::raycast {

namespace {

struct Entry {
  const char* name;
  std::unique_ptr<RayCaster> (*make)(const scene::Scene&);
};
constexpr std::array catalogue{Entry{"embree", make_embree_caster}, Entry{"brute", make_brute_caster}};

}  // namespace

void RayCaster::closest_each(std::span<const Ray> rays, std::span<std::optional<scene::SurfacePoint>> hits) const {
  if (hits.size() < rays.size()) throw core::PreconditionError("closest_each: one answer per ray expected");
  for (std::size_t k = 0; k < rays.size(); ++k) hits[k] = closest(rays[k]);
}

void RayCaster::all(const Ray& ray, std::vector<scene::SurfacePoint>& hits) const {
  hits.clear();
  Ray rest = ray;
  while (const auto hit = closest(rest)) {
    hits.push_back(*hit);
    rest = {hit->position, ray.direction, -hit->normal};
  }
}

std::unique_ptr<RayCaster> make_ray_caster(const std::string& name, const scene::Scene& scene) {
  std::string known;
  for (const Entry& entry : catalogue) {
    if (name == entry.name) return entry.make(scene);
    known += (known.empty() ? "" : ", ") + std::string(entry.name);
  }
  throw core::InputError("intersector '" + name + "'", "one of " + known + " expected");
}

std::vector<std::string> ray_caster_names() {
  std::vector<std::string> names;
  for (const Entry& entry : catalogue) names.emplace_back(entry.name);
  return names;
}

}  // namespace interflect::raycast

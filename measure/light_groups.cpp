#include "measure/light_groups.h"

#include <algorithm>

#include "core/error.h"

namespace interflect::measure {
namespace {

constexpr const char* sky = "sky";

/// And those beside surfaces, by their names.
std::vector<std::string> all_groups(const scene::Scene& scene) {
  std::vector<std::string> names = light_groups(scene);
  const auto add = [&](const auto& lights) {
    for (const auto& light : lights) names.push_back(light.name);
  };
  add(scene.lights.points), add(scene.lights.spots), add(scene.lights.spheres), add(scene.lights.suns);
  if (scene.lights.has_sky()) names.emplace_back(sky);
  return names;
}

}  // namespace

std::vector<std::string> light_groups(const scene::Scene& scene) {
  std::vector<std::string> names;
  for (const scene::SurfaceId id : scene.surface_ids()) {
    const scene::Material& material = scene.material(id);
    if (material.exitance.is_zero()) continue;
    if (std::find(names.begin(), names.end(), material.light_group()) == names.end())
      names.push_back(material.light_group());
  }
  return names;
}

scene::Scene lit_by(scene::Scene scene, const std::string& group) {
  const std::vector<std::string> known = all_groups(scene);
  if (std::ranges::find(known, group) == known.end()) {
    std::string list;
    for (const std::string& name : known) list += (list.empty() ? "" : ", ") + name;
    throw core::InputError("light group '" + group + "'",
                           list.empty() ? "nothing shines in " + scene.file.string() : "one of " + list + " expected");
  }
  for (scene::Material& material : scene.materials)
    if (material.light_group() != group) material.exitance = Spectrum::zero();
  const auto is_other = [&](const auto& light) { return light.name != group; };
  std::erase_if(scene.lights.points, is_other);
  std::erase_if(scene.lights.spots, is_other);
  std::erase_if(scene.lights.suns, is_other);
  for (scene::SphereLight& ball : scene.lights.spheres)
    if (is_other(ball)) ball.exitance = Spectrum::zero();
  if (group != sky) scene.lights.sky = std::monostate{};
  return scene;
}

}  // namespace interflect::measure

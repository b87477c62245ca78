#include "measure/light_groups.h"

#include <algorithm>

namespace interflect::measure {

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

}  // namespace interflect::measure

#include "montecarlo/surface_optics.h"

#include "montecarlo/bsdf/of_material.h"

namespace interflect::montecarlo {

SurfaceOptics::SurfaceOptics(const scene::Scene& scene) {
  for (const scene::Material& material : scene.materials) {
    of_materials_.push_back(bsdf_of(material));
    any_lets_pass_ = any_lets_pass_ || (of_materials_.back() && of_materials_.back()->lets_pass());
  }
  for (const scene::SurfaceId id : scene.surface_ids()) {
    bsdf_.push_back(of_materials_[scene.surface(id).material.value].get());
    if (bsdf_.back() != nullptr && bsdf_.back()->mirrors()) any_mirror_ = id;
    for (const scene::Side side : {scene::Side::front, scene::Side::back})
      exitance_.push_back(scene.material(id).exitance_of(side));
  }
}

}  // namespace interflect::montecarlo

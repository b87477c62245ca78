#pragma once

#include <optional>

#include "core/hemisphere.h"
#include "fem/element_point.h"
#include "raycast/ray_caster.h"
#include "scene/scene.h"

namespace interflect::fem {

struct ElementRay {
  raycast::Ray ray;
  double weight;  ///< of its starting point, whose mean is 1 (ElementMap)
};

/// Cosine-distributed rays from an element, as four numbers in [0, 1) say: two for the place, two for the direction.
class ElementRays {
 public:
  explicit ElementRays(const scene::SurfacePatch& patch);
  ElementRay operator()(double s, double t, double u, double v) const;

 private:
  ElementMap map_;
  core::Frame frame_;
};

/// Whether light is lost there: it hits nothing, or a side without elements, which absorbs it.
bool is_lost(const scene::Scene& scene, const std::optional<scene::SurfacePoint>& hit);

}  // namespace interflect::fem

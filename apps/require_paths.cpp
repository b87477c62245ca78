#include "apps/require_paths.h"

#include "core/error.h"
#include "montecarlo/scene_paths.h"

namespace interflect::apps {

void require_paths(const scene::Scene& scene, const std::string& expression) {
  const measure::PathClasses asked = measure::PathClasses::of(expression), there = montecarlo::paths_in(scene);
  if (there.empty() || !(there & asked).empty()) return;  // without light all is black, and was warned of
  throw core::InputError("--paths '" + expression + "'",
                         "there are none such in this scene, whose paths are " + there.expression());
}

}  // namespace interflect::apps

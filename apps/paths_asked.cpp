#include "apps/paths_asked.h"

#include "core/error.h"
#include "montecarlo/scene_paths.h"

namespace interflect::apps {

measure::PathClasses paths_asked(const scene::Scene& scene, const std::string& expression) {
  const measure::PathClasses asked = measure::PathClasses::of(expression), there = montecarlo::paths_in(scene);
  if (!there.empty() && (there & asked).empty())
    throw core::InputError("--paths '" + expression + "'",
                           "there are none such in this scene, whose paths are " + there.expression());
  return asked;
}

}  // namespace interflect::apps

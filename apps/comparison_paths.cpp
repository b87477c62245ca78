#include "apps/comparison_paths.h"

#include <utility>

#include "montecarlo/integrators.h"
#include "montecarlo/scene_paths.h"

namespace interflect::apps {

ComparedPaths::ComparedPaths(const scene::Scene& scene, scene::CameraId camera, measure::PathClasses asked)
    : pixel_(measure::PixelRadiance{camera, 0, 0}),
      asked_(std::move(asked)),
      there_(montecarlo::that_reach(pixel_, montecarlo::paths_in(scene)) & asked_) {}

PicturePaths ComparedPaths::found_by(const std::string& integrator) const {
  const auto finds = montecarlo::make_integrator(integrator, {})->capabilities().paths_to(pixel_);
  const std::string missed = (there_ - finds).shortest();
  return {missed.empty() ? asked_ : asked_ & finds, missed};
}

PicturePaths ComparedPaths::found_by_both(const PicturePaths& a, const PicturePaths& b) const {
  const measure::PathClasses common = a.paths & b.paths;
  if (are_same(common, a.paths)) return a;
  if (are_same(common, b.paths)) return b;
  return {common, a.missed == b.missed ? a.missed : a.missed + ", " + b.missed};
}

bool ComparedPaths::are_same(const measure::PathClasses& a, const measure::PathClasses& b) const {
  return ((there_ & a) - b).empty() && ((there_ & b) - a).empty();
}

}  // namespace interflect::apps

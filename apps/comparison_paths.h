#pragma once

#include <string>

#include "measure/measurement.h"
#include "measure/path_classes.h"
#include "scene/scene.h"

namespace interflect::apps {

/// Paths of light that a picture is of.
struct PicturePaths {
  measure::PathClasses paths;
  std::string missed;  ///< one of those asked for that it leaves out; of a pair, one of each; empty: none
};

/// Which paths the pictures of a comparison are of, as measurements are compared (montecarlo::compare_integrators):
/// each integrator's of those that it finds, a pair's of those that both find.
class ComparedPaths {
 public:
  /// @param asked  paths that count
  ComparedPaths(const scene::Scene& scene, scene::CameraId camera, measure::PathClasses asked);

  PicturePaths found_by(const std::string& integrator) const;
  PicturePaths found_by_both(const PicturePaths& a, const PicturePaths& b) const;

  /// Whether light takes no such path into a pixel of this scene.
  bool none(const measure::PathClasses& paths) const { return (there_ & paths).empty(); }
  /// Whether they are the same paths in this scene.
  bool are_same(const measure::PathClasses& a, const measure::PathClasses& b) const;

 private:
  measure::Measurement pixel_;
  measure::PathClasses asked_, there_;  ///< there: those asked for that this scene may have
};

}  // namespace interflect::apps

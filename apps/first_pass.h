#pragma once

#include <memory>
#include <string>
#include <vector>

#include "fem/specular/mirrored_light.h"
#include "measure/path_classes.h"
#include "measure/surface_solution.h"
#include "scene/scene.h"

namespace interflect::apps {

/// The radiosity solution that two passes and controlled paths start from, where any integrator asked for needs one.
class FirstPass {
 public:
  /// Solves the scene, with the element size of `interflect solve`, if that is needed and the second pass may follow.
  /// What cannot be solved is told where it is asked for.
  /// @param paths  that count in the second pass, of what inherits the solution's error
  /// @throws core::Interrupted
  FirstPass(const scene::Scene& scene, const std::vector<std::string>& integrators, const measure::PathClasses& paths,
            const std::string& intersector, Run& run);

  /// @throws core::InputError  why there is none, where one was needed
  void require_solved() const;
  /// Of what is here.
  measure::SurfaceSolution solution() const;

 private:
  struct Solved {
    fem::RadiositySolution radiosity;
    fem::MirroredLight mirrored;
  };
  std::unique_ptr<Solved> solved_;
  std::string refused_;
  double processor_seconds_ = 0;
};

}  // namespace interflect::apps

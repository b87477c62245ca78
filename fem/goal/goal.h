#pragma once

#include <string>
#include <variant>
#include <vector>

#include "measure/measurement.h"
#include "mesh/element_mesh.h"
#include "raycast/ray_caster.h"
#include "solvers/transport_operator.h"

namespace interflect::fem {

/// A number that a solution is wanted for, linear in radiosity and never less for more of it:
///
///   J(B) = int c(y) B(y) dy + int s(x) (T B)(x) dx,     c >= 0, s >= 0
struct Goal {
  /// Mean irradiance at points, all worth the same: of sensors and work planes.
  struct AtPoints {
    std::vector<measure::PointIrradiance> points;
  };
  /// Mean irradiance of a side of a surface.
  struct OnSurface {
    scene::SurfaceId surface;
    scene::Side side;
  };
  /// Mean radiance B / pi of the pixels of a camera, of what its rays see: importance [Smits, Arvo, Salesin 1992].
  struct InView {
    scene::CameraId camera;
  };
  std::string name;
  std::variant<AtPoints, OnSurface, InView> what;
};

/// A goal on elements: J(B_h) = sum_a direct_a b_a + sum_i A_i arriving_i H_i with the means H_i.
struct GoalWeights {
  int order;                     ///< of the functions behind `direct`
  std::vector<double> direct;    ///< int c N_a, element after element
  std::vector<double> arriving;  ///< s of elements [1/m²]; empty: none
};

/// @throws core::InputError  where no element has anything to do with it
GoalWeights weights_of(const Goal& goal, const scene::Scene& scene, const mesh::ElementMesh& mesh,
                       const raycast::RayCaster& rays, int order, Run& run);

}  // namespace interflect::fem

#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fem/goal/goal.h"
#include "fem/radiosity.h"

namespace interflect::fem {

/// A solver on its way, on the operator that all have.
struct SolverScore {
  /// What an iteration left and cost.
  struct At {
    double rows;     ///< of K, or rays of those that sample
    double seconds;  ///< looking at it not counted
    double
        error;  ///< of what there is to be seen, or of the goal, against the solution: relative, L2 over the surfaces
    double residual;  ///< relative, as stopping rules have it; or the standard error that is stated
  };
  std::string solver;
  bool samples;
  std::vector<At> history;
  std::string why;  ///< it stopped; or what it says of an operator that it cannot have
};

/// What all of them are asked, and the mesh's size.
struct SolverComparison {
  Index elements, unknowns;
  bool of_goal;  ///< errors are
  std::vector<SolverScore> scores;
};

/// Solvers by name, to `stopping` of the settings each, on one operator: constants or polynomials, or values at nodes.
/// The solution that they are held against is that of `automatic` to 1e-13.
/// @param goal  the one number that is asked for, if it is one: errors are of it then, and so is the noise at which
///              those stop that sample
/// @param scored  called with each score when it is there
/// @throws core::InputError  as solve_radiosity
/// @throws core::Interrupted
SolverComparison compare_solvers(const scene::Scene& scene, const RadiositySettings& settings,
                                 std::span<const std::string> names, const std::optional<Goal>& goal, Run& run,
                                 const std::function<void(const SolverScore&)>& scored);

}  // namespace interflect::fem

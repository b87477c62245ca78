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
    double residual;                ///< relative, as stopping rules have it; or the standard error that is stated
    Spectrum goal{}, goal_error{};  ///< J, if it is asked for, and its standard error: 0 of those that do not sample
  };
  std::string solver;
  bool samples;
  std::vector<At> history;
  std::string why;       ///< it stopped; or what it says of an operator that it cannot have
  bool stopped = false;  ///< it was asked to: the history is of what it did until then
};

/// What all of them are asked, and the mesh's size.
struct SolverComparison {
  Index elements, unknowns;
  std::optional<Spectrum> goal;  ///< J of the solution that all are held against, if it is asked for
  std::vector<SolverScore> scores;
  std::vector<std::string> left_out;                 ///< the run was asked to stop before these had anything
  bool of_goal() const { return goal.has_value(); }  ///< errors are
  bool stopped() const { return !left_out.empty() || (!scores.empty() && scores.back().stopped); }
};

/// Solvers by name, to `stopping` of the settings each, on one operator: constants or polynomials, or values at nodes.
/// The solution that they are held against is that of `automatic` to 1e-13.  A run that is asked to stop keeps the
/// scores that there are, and that of the solver at work.
/// @param goal  the one number that is asked for, if it is one: errors are of it then, and so is the noise at which
///              those stop that sample
/// @param scored  called with each score when it is there
/// @throws core::InputError  as solve_radiosity
/// @throws core::Interrupted  asked to stop before any solver had an iteration
SolverComparison compare_solvers(const scene::Scene& scene, const RadiositySettings& settings,
                                 std::span<const std::string> names, const std::optional<Goal>& goal, Run& run,
                                 const std::function<void(const SolverScore&)>& scored);

}  // namespace interflect::fem

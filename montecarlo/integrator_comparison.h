#pragma once

#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "core/run.h"
#include "measure/method.h"
#include "montecarlo/integrators.h"
#include "montecarlo/sample_report.h"

namespace interflect::montecarlo {

/// Root mean squares, relative to the values, over the measurements whose weighed value is not 0, in the scene's weights.
struct RelativeErrors {
  double noise = 0;      ///< standard errors
  double bound = 0;      ///< error bounds
  std::size_t over = 0;  ///< how many measurements these are of

  double both() const { return std::hypot(noise, bound); }
};

/// What an integrator found of a list of measurements of one kind.
struct IntegratorTrial {
  std::string integrator;
  std::string refused;         ///< why it does not answer; empty: it does
  std::string missed;          ///< one of the paths that it was not asked for, since it misses them; empty: none
  measure::PathClasses paths;  ///< that were asked for
  std::vector<Estimate> found;
  double processor_seconds = 0;  ///< of all threads, pilots, and a solution that it needs, and all
  SampleReport report = {};      ///< of the samples behind `found`

  RelativeErrors relative_errors(const scene::Scene& scene) const;
  /// 1 / (relative error² x processor time) [1/s], the error being `both` of the relative ones; 0 where nothing is known.
  /// Twice the samples leave it as it is where there is no bias.
  double efficiency(const scene::Scene& scene) const;
};

/// Two of them on the paths that both find.
struct IntegratorPair {
  std::size_t a, b;
  measure::PathClasses common;
  std::vector<Estimate> of_a, of_b;
  SampleReport report = {};  ///< of runs on these paths alone that were made for it, and for no pair before
  /// The same by small runs of other seeds, which have as many samples as these all together: [replication].  None
  /// where none were asked for, or what one is wrong by is not of its seeds, or the run was stopped before.
  std::vector<std::vector<Estimate>> again_a = {}, again_b = {};
};

/// Processor time of all threads [s].
struct ComparisonTimes {
  double measuring = 0;        ///< of trials, without solutions that they start from
  double on_common_paths = 0;  ///< of those asked once more, for pairs that find different paths
  double replications = 0;
};

struct IntegratorComparison {
  std::vector<IntegratorTrial> trials;  ///< in the order of the names
  std::vector<IntegratorPair> pairs;    ///< of those that answered, and have paths in common
  ComparisonTimes times = {};
};

struct ComparisonSettings {
  int replications = 0;               ///< of each pair, to learn how its measurements hang together
  std::string what = "measurements";  ///< is asked for: in the names of steps
};

/// Runs each of them on what it finds of `settings.paths`, and those of a pair whose paths differ in this scene once
/// more, once for each set of paths that it has in common with others.
/// @param asked  of one kind: patches and fluxes, points, or pixels
/// What has no answer when the run is stopped is refused, and held against nothing.
/// @throws core::Interrupted  if none has one
IntegratorComparison compare_integrators(const scene::Scene& scene, std::span<const measure::Measurement> asked,
                                         const std::vector<std::string>& names, const IntegratorSettings& settings,
                                         Run& run, const ComparisonSettings& comparison = {});

}  // namespace interflect::montecarlo

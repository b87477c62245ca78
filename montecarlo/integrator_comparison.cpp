#include "montecarlo/integrator_comparison.h"

#include <algorithm>
#include <cmath>
#include <ctime>

#include "core/error.h"
#include "montecarlo/scene_paths.h"
#include "montecarlo/tally.h"

namespace interflect::montecarlo {
namespace {

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

class Comparing {
 public:
  Comparing(const scene::Scene& scene, std::span<const measure::Measurement> asked, const IntegratorSettings& settings,
            Run& run)
      : scene_(scene), asked_(asked), settings_(settings), run_(run), there_(that_reach(asked[0], paths_in(scene))) {}

  IntegratorTrial trial(const std::string& name) const {
    IntegratorTrial trial{name, "", "", settings_.paths, {}, 0};
    const auto finds = make_integrator(name, settings_)->capabilities().paths_to(asked_[0]);
    if (const auto missed = (there_ & settings_.paths) - finds; !missed.empty()) {
      trial.missed = missed.shortest();
      trial.paths = settings_.paths & finds;
      if (empty(trial.paths)) {
        trial.refused = "finds none of these paths, " + trial.missed;
        return trial;
      }
    }
    const double begin = processor_seconds();
    try {
      trial.found = answers(name, trial.paths);
    } catch (const core::InputError& error) {
      trial.refused = error.what();
    } catch (const core::Interrupted&) {
      trial.refused = "stopped before it had an answer";
    }
    trial.processor_seconds = processor_seconds() - begin;
    return trial;
  }

  /// What a trial found of these paths: what it has, if in this scene they are all that it was asked for.
  std::vector<Estimate> of(const IntegratorTrial& trial, const measure::PathClasses& paths) const {
    if (((there_ & trial.paths) - paths).empty()) return trial.found;
    return answers(trial.integrator, paths);
  }

  bool empty(const measure::PathClasses& paths) const { return (there_ & paths).empty(); }

 private:
  std::vector<Estimate> answers(const std::string& name, const measure::PathClasses& paths) const {
    IntegratorSettings settings = settings_;
    settings.paths = paths;
    return make_integrator(name, settings)->answer(scene_, asked_, run_);
  }

  const scene::Scene& scene_;
  std::span<const measure::Measurement> asked_;
  const IntegratorSettings& settings_;
  Run& run_;
  measure::PathClasses there_;
};

}  // namespace

double IntegratorTrial::efficiency(const scene::Scene& scene) const {
  double variance = 0;
  int count = 0;
  for (const Estimate& each : found) {
    const double value = scene.weigh(each.value);
    if (value == 0) continue;
    const double error = std::hypot(weighed_standard_error(scene, each), scene.weigh(each.error_bound));
    variance += error * error / (value * value);
    ++count;
  }
  return count > 0 ? count / (variance * processor_seconds) : 0;
}

IntegratorComparison compare_integrators(const scene::Scene& scene, std::span<const measure::Measurement> asked,
                                         const std::vector<std::string>& names, const IntegratorSettings& settings,
                                         Run& run) {
  IntegratorComparison comparison;
  if (asked.empty()) return comparison;
  const Comparing comparing(scene, asked, settings, run);
  for (const std::string& name : names) comparison.trials.push_back(comparing.trial(name));
  const auto& trials = comparison.trials;
  if (std::ranges::all_of(trials, [](const IntegratorTrial& trial) { return trial.found.empty(); }))
    run.throw_if_stopped("comparing");
  for (std::size_t a = 0; a < trials.size(); ++a)
    for (std::size_t b = a + 1; b < trials.size(); ++b) {
      if (!trials[a].refused.empty() || !trials[b].refused.empty()) continue;
      const measure::PathClasses common = trials[a].paths & trials[b].paths;
      if (comparing.empty(common)) continue;
      try {
        comparison.pairs.push_back({a, b, common, comparing.of(trials[a], common), comparing.of(trials[b], common)});
      } catch (const core::Interrupted&) {
        // What a stop leaves no answers for is not held against each other.
      }
    }
  return comparison;
}

}  // namespace interflect::montecarlo

#include "montecarlo/integrator_comparison.h"

#include <algorithm>
#include <cmath>
#include <ctime>

#include "core/error.h"
#include "core/random.h"
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
      trial.found = answers(name, trial.paths, trial.report);
    } catch (const core::InputError& error) {
      trial.refused = error.what();
    } catch (const core::Interrupted&) {
      trial.refused = "stopped before it had an answer";
    }
    trial.processor_seconds = processor_seconds() - begin;
    if (integrator_entry(name).needs_solution) trial.processor_seconds += settings_.solution.processor_seconds;
    return trial;
  }

  /// What a trial found of these paths: what it has, if in this scene they are all that it was asked for.
  std::vector<Estimate> of(const IntegratorTrial& trial, const measure::PathClasses& paths,
                           SampleReport& report) const {
    if (are_all(trial, paths)) return trial.found;
    return answers(trial.integrator, paths, report);
  }

  /// Small runs of other seeds, with as many samples as `found` has; none if the run is stopped before all are done.
  std::vector<std::vector<Estimate>> again(const IntegratorTrial& trial, const measure::PathClasses& paths,
                                           std::span<const Estimate> found, int replications) const {
    if (integrator_entry(trial.integrator).by_quadrature)
      return std::vector(static_cast<std::size_t>(replications), std::vector(found.begin(), found.end()));
    double samples = 0;
    for (const Estimate& each : found) samples += static_cast<double>(each.samples) / static_cast<double>(found.size());
    IntegratorSettings settings = settings_;
    settings.paths = paths;
    settings.samples = std::max<std::uint64_t>(2, static_cast<std::uint64_t>(samples / replications));
    const auto integrator = make_integrator(trial.integrator, settings);
    std::vector<std::vector<Estimate>> again;
    for (int k = 0; k < replications && !run_.stop.stop_requested(); ++k) {
      const std::uint64_t seed = core::derived_seed(run_.seed, "replication " + std::to_string(k));
      Run other{seed, run_.threads, run_.progress, run_.stop};
      again.push_back(integrator->answer(scene_, asked_, other));
    }
    if (run_.stop.stop_requested()) again.clear();
    return again;
  }
  /// Whether seeds, or a bound that is told, account for all that it is wrong by: else replications would tell nothing.
  static bool errs_by_chance(const std::string& name) {
    return integrator_entry(name).by_quadrature || make_integrator(name, {})->capabilities().unbiased;
  }
  void replicate(std::vector<IntegratorTrial>& trials, IntegratorPair& pair, int replications) const {
    if (!errs_by_chance(trials[pair.a].integrator) || !errs_by_chance(trials[pair.b].integrator)) return;
    const auto of = [&](IntegratorTrial& trial, std::span<const Estimate> found) {
      if (!are_all(trial, pair.common)) return again(trial, pair.common, found, replications);
      if (trial.again.empty()) trial.again = again(trial, pair.common, found, replications);
      return trial.again;
    };
    try {
      pair.again_a = of(trials[pair.a], pair.of_a);
      pair.again_b = of(trials[pair.b], pair.of_b);
    } catch (const core::Interrupted&) {
    }
    if (pair.again_a.size() != pair.again_b.size()) pair.again_a.clear(), pair.again_b.clear();
  }

  bool empty(const measure::PathClasses& paths) const { return (there_ & paths).empty(); }

 private:
  /// Whether these are all that a trial was asked for, in this scene.
  bool are_all(const IntegratorTrial& trial, const measure::PathClasses& paths) const {
    return ((there_ & trial.paths) - paths).empty();
  }
  std::vector<Estimate> answers(const std::string& name, const measure::PathClasses& paths,
                                SampleReport& report) const {
    IntegratorSettings settings = settings_;
    settings.paths = paths;
    settings.report = &report;
    return make_integrator(name, settings)->answer(scene_, asked_, run_);
  }

  const scene::Scene& scene_;
  std::span<const measure::Measurement> asked_;
  const IntegratorSettings& settings_;
  Run& run_;
  measure::PathClasses there_;
};

}  // namespace

RelativeErrors IntegratorTrial::relative_errors(const scene::Scene& scene) const {
  double noise = 0, bound = 0;
  std::size_t over = 0;
  const auto square = [](double x) { return x * x; };
  for (const Estimate& each : found) {
    const double value = scene.weigh(each.value);
    if (value == 0) continue;
    noise += square(weighed_standard_error(scene, each) / value);
    bound += square(scene.weigh(each.error_bound) / value);
    ++over;
  }
  if (over == 0) return {};
  const auto count = static_cast<double>(over);
  return {std::sqrt(noise / count), std::sqrt(bound / count), over};
}

double IntegratorTrial::efficiency(const scene::Scene& scene) const {
  const RelativeErrors errors = relative_errors(scene);
  return errors.over > 0 ? 1 / (errors.both() * errors.both() * processor_seconds) : 0;
}

IntegratorComparison compare_integrators(const scene::Scene& scene, std::span<const measure::Measurement> asked,
                                         const std::vector<std::string>& names, const IntegratorSettings& settings,
                                         Run& run, int replications) {
  IntegratorComparison comparison;
  if (asked.empty()) return comparison;
  const Comparing comparing(scene, asked, settings, run);
  for (const std::string& name : names) comparison.trials.push_back(comparing.trial(name));
  std::vector<IntegratorTrial>& trials = comparison.trials;
  if (std::ranges::all_of(trials, [](const IntegratorTrial& trial) { return trial.found.empty(); }))
    run.throw_if_stopped("comparing");
  for (std::size_t a = 0; a < trials.size(); ++a)
    for (std::size_t b = a + 1; b < trials.size(); ++b) {
      if (!trials[a].refused.empty() || !trials[b].refused.empty()) continue;
      const measure::PathClasses common = trials[a].paths & trials[b].paths;
      if (comparing.empty(common)) continue;
      try {
        IntegratorPair pair{a, b, common, {}, {}};
        pair.of_a = comparing.of(trials[a], common, pair.report);
        pair.of_b = comparing.of(trials[b], common, pair.report);
        comparison.pairs.push_back(std::move(pair));
        if (replications > 0) comparing.replicate(trials, comparison.pairs.back(), replications);
      } catch (const core::Interrupted&) {
        // What a stop leaves no answers for is not held against each other.
      }
    }
  return comparison;
}

}  // namespace interflect::montecarlo

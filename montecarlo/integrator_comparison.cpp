#include "montecarlo/integrator_comparison.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.h"
#include "core/processor_time.h"
#include "core/random.h"
#include "montecarlo/scene_paths.h"
#include "montecarlo/surface_optics.h"
#include "montecarlo/tally.h"

namespace interflect::montecarlo {
namespace {

/// What an integrator found of some paths, and found again.
struct Answers {
  measure::PathClasses paths;
  std::vector<Estimate> found;
  SampleReport report;
  std::vector<std::vector<Estimate>> again = {};
};

class Comparing {
 public:
  Comparing(const scene::Scene& scene, std::span<const measure::Measurement> asked, const IntegratorSettings& settings,
            const ComparisonSettings& comparison, Run& run)
      : scene_(scene),
        asked_(asked),
        settings_(settings),
        comparison_(comparison),
        run_(run),
        there_(that_reach(asked[0], paths_in(scene))) {
    const SurfaceOptics of_nobody(scene);  // tables of its rough surfaces are made once, and on nobody's time
  }

  IntegratorComparison compared(const std::vector<std::string>& names) {
    answers_.resize(names.size());
    for (std::size_t k = 0; k < names.size(); ++k) made_.trials.push_back(trial(k, names[k]));
    if (std::ranges::all_of(made_.trials, [](const IntegratorTrial& trial) { return trial.found.empty(); }))
      run_.throw_if_stopped("comparing");
    for (std::size_t a = 0; a < names.size(); ++a)
      for (std::size_t b = a + 1; b < names.size(); ++b) compare(a, b);
    return std::move(made_);
  }

 private:
  IntegratorTrial trial(std::size_t k, const std::string& name) {
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
    try {
      const core::ProcessorTime timed(trial.processor_seconds);
      answers_[k].push_back(answers(name, trial.paths, name + ": " + comparison_.what));
      trial.found = answers_[k].front().found;
      trial.report = answers_[k].front().report;
    } catch (const core::InputError& error) {
      trial.refused = error.what();
    } catch (const core::Interrupted&) {
      trial.refused = "stopped before it had an answer";
    }
    made_.times.measuring += trial.processor_seconds;
    if (integrator_entry(name).needs_solution) trial.processor_seconds += settings_.solution.processor_seconds;
    return trial;
  }

  /// Holds two against each other.  What a stop leaves no answers for is not.
  void compare(std::size_t a, std::size_t b) {
    const IntegratorTrial &of_a = made_.trials[a], &of_b = made_.trials[b];
    if (!of_a.refused.empty() || !of_b.refused.empty()) return;
    const measure::PathClasses common = of_a.paths & of_b.paths;
    if (empty(common)) return;
    try {
      IntegratorPair pair{a, b, common, {}, {}};
      pair.of_a = of(a, common, pair.report).found;
      pair.of_b = of(b, common, pair.report).found;
      made_.pairs.push_back(std::move(pair));
      replicate(made_.pairs.back());
    } catch (const core::Interrupted&) {
    }
  }

  /// What one finds of these paths: what it has, if in this scene they are those that it was asked for, by itself or
  /// for another pair.
  /// @param report  is added to, of what it was asked now
  const Answers& of(std::size_t k, const measure::PathClasses& paths, SampleReport& report) {
    const std::size_t n = at(k, paths);
    if (n < answers_[k].size()) return answers_[k][n];
    const core::ProcessorTime timed(made_.times.on_common_paths);
    const std::string& name = made_.trials[k].integrator;
    answers_[k].push_back(answers(name, paths, name + ": " + comparison_.what + " on common paths"));
    std::vector<std::size_t> all(asked_.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    report.add(answers_[k].back().report, all);
    return answers_[k].back();
  }

  void replicate(IntegratorPair& pair) {
    if (comparison_.replications == 0) return;
    if (!errs_by_chance(made_.trials[pair.a].integrator) || !errs_by_chance(made_.trials[pair.b].integrator)) return;
    const core::ProcessorTime timed(made_.times.replications);
    try {
      pair.again_a = again(pair.a, answers_[pair.a][at(pair.a, pair.common)]);
      pair.again_b = again(pair.b, answers_[pair.b][at(pair.b, pair.common)]);
    } catch (const core::Interrupted&) {
    }
    if (pair.again_a.size() != pair.again_b.size()) pair.again_a.clear(), pair.again_b.clear();
  }

  /// Small runs of other seeds, of as many samples as were found by; none if the run is stopped before all are done.
  const std::vector<std::vector<Estimate>>& again(std::size_t k, Answers& of) {
    const std::string& name = made_.trials[k].integrator;
    if (of.again.empty()) of.again = integrator_entry(name).by_quadrature ? the_same(of) : replications(name, of);
    return of.again;
  }
  std::vector<std::vector<Estimate>> the_same(const Answers& of) const {
    return std::vector(static_cast<std::size_t>(comparison_.replications), of.found);
  }
  std::vector<std::vector<Estimate>> replications(const std::string& name, const Answers& of) const {
    const int count = comparison_.replications;
    double samples = 0;
    for (const Estimate& each : of.found)
      samples += static_cast<double>(each.samples) / static_cast<double>(of.found.size());
    IntegratorSettings settings = settings_;
    settings.paths = of.paths;
    settings.samples = std::max<std::uint64_t>(2, static_cast<std::uint64_t>(samples / count));
    const auto integrator = make_integrator(name, settings);
    core::Progress quiet;  // each is short, and all together are one stage
    core::Progress::Stage stage(run_.progress, name + ": replications of " + comparison_.what,
                                static_cast<std::uint64_t>(count));
    std::vector<std::vector<Estimate>> again;
    for (int k = 0; k < count && !run_.stop.stop_requested(); ++k) {
      Run other{core::derived_seed(run_.seed, "replication " + std::to_string(k)), run_.threads, quiet, run_.stop,
                run_.late};
      again.push_back(integrator->answer(scene_, asked_, other));
      stage.advance();
    }
    if (run_.stop.stop_requested()) again.clear();
    return again;
  }
  /// Whether seeds, or a bound that is told, account for all that it is wrong by: else replications would tell nothing.
  static bool errs_by_chance(const std::string& name) {
    return integrator_entry(name).by_quadrature || make_integrator(name, {})->capabilities().unbiased;
  }

  bool empty(const measure::PathClasses& paths) const { return (there_ & paths).empty(); }
  bool are_same(const measure::PathClasses& a, const measure::PathClasses& b) const {
    return ((there_ & a) - b).empty() && ((there_ & b) - a).empty();
  }
  /// Which of its answers are of these paths, the end of them where none are.
  std::size_t at(std::size_t k, const measure::PathClasses& paths) const {
    const auto found =
        std::ranges::find_if(answers_[k], [&](const Answers& each) { return are_same(each.paths, paths); });
    return static_cast<std::size_t>(found - answers_[k].begin());
  }
  Answers answers(const std::string& name, const measure::PathClasses& paths, const std::string& step) const {
    Answers of{paths, {}, {}};
    IntegratorSettings settings = settings_;
    settings.paths = paths;
    settings.report = &of.report;
    core::Progress progress(run_.progress, step);
    Run labelled{run_.seed, run_.threads, progress, run_.stop, run_.late};
    of.found = make_integrator(name, settings)->answer(scene_, asked_, labelled);
    return of;
  }

  const scene::Scene& scene_;
  std::span<const measure::Measurement> asked_;
  const IntegratorSettings& settings_;
  const ComparisonSettings& comparison_;
  Run& run_;
  measure::PathClasses there_;
  std::vector<std::vector<Answers>> answers_;  ///< of each trial: its own first, then on the paths of pairs
  IntegratorComparison made_;
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
                                         Run& run, const ComparisonSettings& comparison) {
  if (asked.empty()) return {};
  return Comparing(scene, asked, settings, comparison, run).compared(names);
}

}  // namespace interflect::montecarlo

#include <algorithm>
#include <cstdio>

#include "apps/commands.h"
#include "apps/goals.h"
#include "apps/read_scene.h"
#include "apps/table.h"
#include "core/error.h"
#include "core/format.h"
#include "fem/solver_comparison.h"
#include "results/atomic_file.h"
#include "results/csv.h"
#include "results/output_directory.h"
#include "results/record.h"
#ifdef INTERFLECT_WITH_VTK
#include "results/image_file.h"
#include "visual/plot.h"
#endif

namespace interflect::apps {
namespace {

using fem::SolverScore;

std::string csv_of(const std::vector<SolverScore>& scores) {
  results::Csv csv;
  for (const char* heading : {"solver", "iteration", "rows_or_rays", "seconds", "error", "residual_or_noise"})
    csv.text(heading);
  csv.end_line();
  for (const SolverScore& score : scores)
    for (std::size_t k = 0; k < score.history.size(); ++k) {
      const SolverScore::At& at = score.history[k];
      csv.text(score.solver).number(static_cast<double>(k + 1)).number(at.rows).number(at.seconds);
      csv.number(at.error).number(at.residual).end_line();
    }
  return csv.str();
}

/// What a solver is judged by.  One number that was sampled is near the truth by luck now and then: it is what is
/// stated then.
double judged(const SolverScore& score, const SolverScore::At& at, bool of_goal) {
  return of_goal && score.samples ? at.residual : at.error;
}

/// The first iteration with an error below, if there is one.
const SolverScore::At* first_below(const SolverScore& score, double error, bool of_goal) {
  for (const SolverScore::At& at : score.history)
    if (judged(score, at, of_goal) <= error) return &at;
  return nullptr;
}

/// It does not take the operator, and `why` is a sentence.
bool refused(const SolverScore& score) {
  return score.history.empty() && score.why != solvers::describe(solvers::SolverReport::Stopped::nothing_to_do);
}

constexpr double milestones[] = {0.1, 1e-2, 1e-6};

/// Why, a line each: below the table, whose column it would make as wide as a sentence.
std::string refusals_text(const fem::SolverComparison& comparison) {
  std::string text;
  for (const SolverScore& score : comparison.scores)
    if (refused(score)) text += "refused: " + score.why + "\n";
  return text;
}

/// What the numbers of the table are.
std::string legend_of(const fem::SolverComparison& comparison, const std::string& goal) {
  const auto any = [&](auto which) { return std::any_of(comparison.scores.begin(), comparison.scores.end(), which); };
  const bool sampled = any([](const SolverScore& score) { return score.samples; });
  std::string text = "error: relative, ";
  text += comparison.of_goal ? "of '" + goal + "'" : std::string("L2 over the surfaces");
  text += ", against the solution of the same equations; what elements cannot show is in none\n";
  text += "work: until the error is below, in sweeps (each uses the whole matrix once; form factors are not counted)";
  text += sampled ? ",\n      or in rays of those that sample, which stop at the noise that --noise asks for\n" : "\n";
  if (sampled && comparison.of_goal)
    text += "      by the standard error that they state: one number that is sampled may be near the truth by luck\n";
  if (any([](const SolverScore& score) { return score.solver == "continuous-shooting"; }))
    text +=
        "continuous-shooting finds light itself, from which the solution of the equations differs: so does its error\n";
  return text;
}

std::string table_of(const fem::SolverComparison& comparison) {
  Table table({"solver", "work to 10 %", "to 1 %", "to 1e-6", "s to 1e-6", "error at end", "s in all", "stopped"});
  for (const SolverScore& score : comparison.scores) {
    std::vector<std::string> row{score.solver};
    for (const double error : milestones) {
      const SolverScore::At* at = first_below(score, error, comparison.of_goal);
      if (score.samples)
        row.push_back(at ? core::format("%.2g rays", at->rows) : "-");
      else
        row.push_back(at ? core::format("%.3g", at->rows / static_cast<double>(comparison.unknowns)) : "-");
    }
    const SolverScore::At* last = first_below(score, milestones[2], comparison.of_goal);
    row.push_back(last ? core::format("%.3g", last->seconds) : "-");
    row.push_back(score.history.empty() ? "-" : core::format("%.2g", score.history.back().error));
    row.push_back(score.history.empty() ? "-" : core::format("%.3g", score.history.back().seconds));
    row.push_back(refused(score) ? "refused" : score.why);
    table.add(std::move(row));
  }
  return table.text() + refusals_text(comparison);
}

results::Record record_of(const fem::SolverComparison& comparison) {
  results::Record::List list;
  for (const SolverScore& score : comparison.scores) {
    results::Record record;
    record.add("solver", score.solver).add("iterations", static_cast<std::int64_t>(score.history.size()));
    record.add("rows_or_rays", score.history.empty() ? 0.0 : score.history.back().rows);
    record.add("seconds", score.history.empty() ? 0.0 : score.history.back().seconds);
    record.add("error", score.history.empty() ? 0.0 : score.history.back().error);
    list.push_back(record.add("stopped", score.why));
  }
  results::Record record;
  return record.add("elements", static_cast<std::int64_t>(comparison.elements))
      .add("unknowns", static_cast<std::int64_t>(comparison.unknowns))
      .add("solvers", std::move(list));
}

#ifdef INTERFLECT_WITH_VTK
/// @param with_samples  those that sample have rays, and no rows; with them in a panel of their own
visual::Plot plot_of(const fem::SolverComparison& comparison, const std::string& x_label, bool with_samples,
                     double (*x)(const SolverScore::At&, double unknowns)) {
  visual::Plot plot{"linear solvers: error against " + x_label,
                    x_label,
                    comparison.of_goal
                        ? "relative error of the goal; of those that sample, the standard error that they state"
                        : "relative error, L2 over the surfaces",
                    {}};
  for (const SolverScore& score : comparison.scores) {
    if (score.samples && !with_samples) continue;
    visual::Plot::Curve curve{score.solver, {}, {}};
    if (with_samples) curve.panel = score.samples ? "those that sample" : "those that have the matrix";
    for (const SolverScore::At& at : score.history) {
      curve.x.push_back(x(at, static_cast<double>(comparison.unknowns)));
      curve.y.push_back(judged(score, at, comparison.of_goal));
    }
    if (!curve.x.empty()) plot.curves.push_back(std::move(curve));
  }
  return plot;
}

void write_plots(const std::filesystem::path& folder, const fem::SolverComparison& comparison) {
  const auto by_work = [](const SolverScore::At& at, double unknowns) { return at.rows / unknowns; };
  const auto by_time = [](const SolverScore::At& at, double) { return at.seconds; };
  results::write_png(folder / "solvers_work.png",
                     visual::plot_picture(plot_of(comparison, "work [sweeps over the matrix]", false, by_work)));
  results::write_png(folder / "solvers_time.png", visual::plot_picture(plot_of(comparison, "time [s]", true, by_time)));
}
#endif

/// Of all, where none are asked for: `automatic` is one of the others, and some are for a goal.
bool is_compared(const std::string& solver, bool with_goal) {
  return solver != "automatic" &&
         (with_goal || solvers::solver_named(solver).needs != solvers::SolverEntry::Needs::target);
}

/// Before the work: those of one number have nothing to do without it.
void require_goal(const std::vector<std::string>& solvers) {
  for (const std::string& solver : solvers)
    if (!is_compared(solver, false) && solver != "automatic")
      throw core::InputError("solver '" + solver + "'",
                             "it finds one number, and --goal says which: a sensor, a surface, or camera:NAME");
}

}  // namespace

ExitStatus compare_solvers(const CompareSolversOptions& options, const CommonOptions& common, Run& run) {
  if (options.goal.empty()) require_goal(options.solvers);
  const scene::Scene scene = read_to_solve(options.scene);
  std::optional<fem::Goal> goal;
  if (!options.goal.empty()) goal = goal_named(options.goal, scene, measure::sensor_points(scene));
  const results::OutputDirectory folder(options.out);
  const bool talk = !common.json && !common.quiet;
  const auto told = [&](const SolverScore& score) {
    if (!talk) return;
    std::printf("%s: %s\n", score.solver.c_str(), refused(score) ? "refused" : score.why.c_str());
    std::fflush(stdout);
  };
  std::vector<std::string> names = options.solvers;
  if (names.empty())
    for (const std::string& each : solvers::solver_names())
      if (is_compared(each, goal.has_value())) names.push_back(each);
  const fem::SolverComparison comparison = fem::compare_solvers(scene, options.settings, names, goal, run, told);
  results::write_atomically(options.out / "solvers.csv", csv_of(comparison.scores));
#ifdef INTERFLECT_WITH_VTK
  write_plots(options.out, comparison);
#endif
  if (common.json) std::printf("%s\n", results::json_text(record_of(comparison)).c_str());
  if (talk)
    std::printf("\n%s elements, %s unknowns\n%s\n%s\nwritten to %s\n",
                core::format_count(static_cast<unsigned long long>(comparison.elements)).c_str(),
                core::format_count(static_cast<unsigned long long>(comparison.unknowns)).c_str(),
                legend_of(comparison, goal ? goal->name : "").c_str(), table_of(comparison).c_str(),
                options.out.string().c_str());
  return success;
}

}  // namespace interflect::apps

#include <algorithm>
#include <cstdio>

#include "apps/commands.h"
#include "apps/goals.h"
#include "apps/leftovers.h"
#include "apps/read_scene.h"
#include "apps/table.h"
#include "apps/with_error.h"
#include "core/error.h"
#include "core/format.h"
#include "core/log.h"
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

std::string csv_of(const fem::SolverComparison& comparison, const scene::Scene& scene) {
  results::Csv csv;
  for (const char* heading : {"solver", "iteration", "rows_or_rays", "seconds", "error", "residual_or_noise"})
    csv.text(heading);
  if (comparison.of_goal()) csv.text("value").text("standard_error").text("value_of_solution");
  csv.end_line();
  for (const SolverScore& score : comparison.scores)
    for (std::size_t k = 0; k < score.history.size(); ++k) {
      const SolverScore::At& at = score.history[k];
      csv.text(score.solver).number(static_cast<double>(k + 1)).number(at.rows).number(at.seconds);
      csv.number(at.error).number(at.residual);
      if (comparison.of_goal())
        csv.number(scene.weigh(at.goal)).number(scene.weigh(at.goal_error)).number(scene.weigh(*comparison.goal));
      csv.end_line();
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

/// What is asked of them, and of what: one number, or all of a solution.
struct Question {
  const scene::Scene& scene;
  std::optional<fem::Goal> goal;
};

/// What the numbers of the table are.
std::string legend_of(const fem::SolverComparison& comparison, const Question& question) {
  const auto any = [&](auto which) { return std::any_of(comparison.scores.begin(), comparison.scores.end(), which); };
  const bool sampled = any([](const SolverScore& score) { return score.samples; });
  std::string text = "error: relative, ";
  text += question.goal ? "of '" + question.goal->name + "'" : std::string("L2 over the surfaces");
  text += ", against the solution of the same equations; what elements cannot show is in none\n";
  text += "work: until the error is below, in sweeps (each uses the whole matrix once; form factors are not counted)";
  text += sampled ? ",\n      or in rays of those that sample, which stop at the noise that --noise asks for\n" : "\n";
  if (sampled && comparison.of_goal())
    text += "      by the standard error that they state: one number that is sampled may be near the truth by luck\n";
  if (question.goal) {
    const auto [quantity, unit] = quantity_of(*question.goal, question.scene);
    text +=
        core::format("value: %s [%s] as the solver has it in the end%s; by the solution %.6g\n", quantity.c_str(), unit,
                     sampled ? ", +- its standard error if it samples" : "", question.scene.weigh(*comparison.goal));
  }
  if (any([](const SolverScore& score) { return score.solver == "continuous-shooting"; }))
    text +=
        "continuous-shooting finds light itself, from which the solution of the equations differs: so does its error\n";
  return text;
}

/// What a solver made of the goal in the end.
std::string value_text(const SolverScore& score, const scene::Scene& scene) {
  if (score.history.empty()) return "-";
  const SolverScore::At& last = score.history.back();
  const double value = scene.weigh(last.goal);
  return score.samples ? with_error(value, scene.weigh(last.goal_error)) : core::format("%.6g", value);
}

std::string table_of(const fem::SolverComparison& comparison, const scene::Scene& scene) {
  std::vector<std::string> heading{"solver",    "work to 10 %", "to 1 %",   "to 1e-6",
                                   "s to 1e-6", "error at end", "s in all", "stopped"};
  if (comparison.of_goal()) heading.insert(heading.end() - 1, "value");
  Table table(std::move(heading));
  for (const SolverScore& score : comparison.scores) {
    std::vector<std::string> row{score.solver};
    for (const double error : milestones) {
      const SolverScore::At* at = first_below(score, error, comparison.of_goal());
      if (score.samples)
        row.push_back(at ? core::format("%.2g rays", at->rows) : "-");
      else
        row.push_back(at ? core::format("%.3g", at->rows / static_cast<double>(comparison.unknowns)) : "-");
    }
    const SolverScore::At* last = first_below(score, milestones[2], comparison.of_goal());
    row.push_back(last ? core::format("%.3g", last->seconds) : "-");
    row.push_back(score.history.empty() ? "-" : core::format("%.2g", score.history.back().error));
    row.push_back(score.history.empty() ? "-" : core::format("%.3g", score.history.back().seconds));
    if (comparison.of_goal()) row.push_back(value_text(score, scene));
    row.push_back(refused(score) ? "refused" : score.why);
    table.add(std::move(row));
  }
  return table.text() + refusals_text(comparison);
}

results::Record record_of(const fem::SolverComparison& comparison, const Question& question) {
  results::Record::List list;
  for (const SolverScore& score : comparison.scores) {
    results::Record record;
    record.add("solver", score.solver).add("iterations", static_cast<std::int64_t>(score.history.size()));
    record.add("rows_or_rays", score.history.empty() ? 0.0 : score.history.back().rows);
    record.add("seconds", score.history.empty() ? 0.0 : score.history.back().seconds);
    record.add("error", score.history.empty() ? 0.0 : score.history.back().error);
    if (question.goal && !score.history.empty())
      record.add("value", question.scene.weigh(score.history.back().goal))
          .add("standard_error", question.scene.weigh(score.history.back().goal_error));
    list.push_back(record.add("stopped", score.why));
  }
  results::Record record;
  record.add("elements", static_cast<std::int64_t>(comparison.elements))
      .add("unknowns", static_cast<std::int64_t>(comparison.unknowns));
  if (question.goal)
    record.add("goal", question.goal->name)
        .add("unit", quantity_of(*question.goal, question.scene).unit)
        .add("value_of_solution", question.scene.weigh(*comparison.goal));
  return record.add("stopped", comparison.stopped())
      .add("left_out", comparison.left_out)
      .add("solvers", std::move(list));
}

#ifdef INTERFLECT_WITH_VTK
enum class Drawn { with_matrix, by_rays, all };

bool is_drawn(const SolverScore& score, Drawn drawn) {
  return !score.history.empty() && (drawn == Drawn::all || score.samples == (drawn == Drawn::by_rays));
}

/// One of errors against what they cost.
struct Picture {
  const char* stem;
  const char* x_label;
  Drawn drawn;  ///< all: those that sample are in a panel of their own
  double (*x)(const SolverScore::At&, double unknowns);
};

visual::Plot plot_of(const fem::SolverComparison& comparison, const Picture& picture) {
  visual::Plot plot{std::string("linear solvers: error against ") + picture.x_label,
                    picture.x_label,
                    comparison.of_goal()
                        ? "relative error of the goal; of those that sample, the standard error that they state"
                        : "relative error, L2 over the surfaces",
                    {}};
  for (const SolverScore& score : comparison.scores) {
    if (!is_drawn(score, picture.drawn)) continue;
    visual::Plot::Curve curve{score.solver, {}, {}};
    if (picture.drawn == Drawn::all) curve.panel = score.samples ? "those that sample" : "those that have the matrix";
    for (const SolverScore::At& at : score.history) {
      curve.x.push_back(picture.x(at, static_cast<double>(comparison.unknowns)));
      curve.y.push_back(judged(score, at, comparison.of_goal()));
    }
    plot.curves.push_back(std::move(curve));
  }
  return plot;
}

/// Those that have a curve: none of rays where nothing samples.
void write_plots(const std::filesystem::path& folder, const fem::SolverComparison& comparison) {
  const auto sweeps = [](const SolverScore::At& at, double unknowns) { return at.rows / unknowns; };
  const auto rays = [](const SolverScore::At& at, double) { return at.rows; };
  const auto time = [](const SolverScore::At& at, double) { return at.seconds; };
  for (const Picture& picture : {Picture{"solvers_work", "work [sweeps over the matrix]", Drawn::with_matrix, sweeps},
                                 Picture{"solvers_rays", "work [rays]", Drawn::by_rays, rays},
                                 Picture{"solvers_time", "time [s]", Drawn::all, time}}) {
    remove_leftovers(folder, {picture.stem});
    const visual::Plot plot = plot_of(comparison, picture);
    if (!plot.curves.empty())
      results::write_png(folder / (std::string(picture.stem) + ".png"), visual::plot_picture(plot));
  }
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

/// In one line, of a run that was stopped.
void say_what_was_left(const fem::SolverComparison& comparison) {
  std::string text = "stopped: ";
  if (comparison.scores.back().stopped) text += comparison.scores.back().solver + " is kept as far as it came";
  std::string names;
  for (const std::string& name : comparison.left_out) names += (names.empty() ? "" : ", ") + name;
  if (!names.empty()) text += (comparison.scores.back().stopped ? "; " : "") + ("left out: " + names);
  core::log::shortfall(text);
}

}  // namespace

ExitStatus compare_solvers(const CompareSolversOptions& options, const CommonOptions& common, Run& run) {
  if (options.goal.empty()) require_goal(options.solvers);
  const scene::Scene scene = read_to_solve(options.scene);
  Question question{scene, {}};
  if (!options.goal.empty()) question.goal = goal_named(options.goal, scene, measure::sensor_points(scene));
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
      if (is_compared(each, question.goal.has_value())) names.push_back(each);
  const fem::SolverComparison comparison =
      fem::compare_solvers(scene, options.settings, names, question.goal, run, told);
  results::write_atomically(options.out / "solvers.csv", csv_of(comparison, scene));
#ifdef INTERFLECT_WITH_VTK
  write_plots(options.out, comparison);
#endif
  if (common.json) std::printf("%s\n", results::json_text(record_of(comparison, question)).c_str());
  if (talk)
    std::printf("\n%s elements, %s unknowns\n%s\n%s\nwritten to %s\n",
                core::format_count(static_cast<unsigned long long>(comparison.elements)).c_str(),
                core::format_count(static_cast<unsigned long long>(comparison.unknowns)).c_str(),
                legend_of(comparison, question).c_str(), table_of(comparison, scene).c_str(),
                options.out.string().c_str());
  if (!comparison.stopped()) return success;
  say_what_was_left(comparison);
  return not_met;
}

}  // namespace interflect::apps

#include "apps/solved_scene.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "apps/goals.h"
#include "apps/proved_bounds.h"
#include "apps/read_scene.h"
#include "core/error.h"
#include "core/format.h"
#include "core/log.h"
#include "fem/specular/specular_chains.h"
#include "results/factor_pairs.h"

namespace interflect::apps {
namespace {

constexpr double noticeable_on_backs = 1e-3;   ///< of the emitted flux: docs/scene.md promises a warning above it
constexpr double noticeable_imbalance = 5e-3;  ///< of the emitted flux, lost or made by form factors
constexpr const char* coincidence =
    ": do faces coincide, meet at a few degrees, or lie closer than elements are long?  See interflect check";

/// K of a file, for the geometry that it is of.
auto factors_from(const std::filesystem::path& file) {
  return [file](const scene::Scene& scene, std::span<const scene::SurfacePatch> elements, fem::ExchangeSink& sink) {
    const results::FactorStore store(file);
    if (const auto count = static_cast<Index>(elements.size()); store.size() != count)
      throw core::InputError(file.string(),
                             core::format("it has the view factors of %td elements, and the scene is cut into %td: the "
                                          "--element-size of that run, and the same scene, expected",
                                          store.size(), count));
    store.require_geometry(results::geometry_digest(scene, elements));
    results::for_pairs(store, [&](Index a, Index b, double K, double error) { sink.add(a, b, {K, 0, error}); });
  };
}

/// With what the scene has to say to them.
fem::RadiositySettings settings_of(const SolveOptions& options, const scene::Scene& scene,
                                   std::span<const measure::SensorPoint> points) {
  fem::RadiositySettings settings = options.settings;
  if (options.target_error > 0 || !options.goal.empty())
    settings.adaptive = {goal_named(options.goal, scene, points), options.target_error};
  if (!options.factors.empty()) settings.stored_factors = factors_from(options.factors);
  return settings;
}

/// Sensors none of whose points sees any light.
std::vector<std::string> blind_sensors(const SolvedScene& solved) {
  std::vector<std::string> warnings;
  for (std::size_t k = 0; k < solved.points.size();) {
    const std::string& sensor = solved.points[k].sensor;
    bool blind = true;
    for (; k < solved.points.size() && solved.points[k].sensor == sensor; ++k)
      blind = blind && solved.at_points[k].value.is_zero();
    if (blind) warnings.push_back("no light reaches sensor '" + sensor + "': is it outside the room, or turned away?");
  }
  return warnings;
}

/// The part of the surfaces on which polynomials dip below 0 by more than their noise, by elements' corners.
double negative_share(const SolvedScene& solved) {
  const fem::RadiositySolution& s = solved.solution;
  double area = 0, negative = 0;
  for (std::size_t i = 0; s.field && i < s.radiosity.size(); ++i) {
    const scene::SurfacePatch& patch = s.mesh.patches()[i];
    area += patch.area;
    for (const Vec3& x : patch.ring())
      if (solved.scene.weigh(s.field->irradiance_at(i, x) + normal_95 * s.field->noise_at(i, x)) < 0)
        negative += patch.area / static_cast<double>(patch.ring().size());
  }
  return area > 0 ? negative / area : 0;
}

/// Flux of pairs that --drop-below left out [W | lm]: if all elements sent the same, and if each lacked the largest part
/// that any does.
struct Dropped {
  double about = 0, most = 0;
};
Dropped dropped_flux(const scene::Scene& scene, const fem::RadiositySolution& solution) {
  if (solution.closure_correction > 0) return {};  // made up for
  double leaving = 0;
  for (std::size_t i = 0; i < solution.radiosity.size(); ++i)
    leaving += solution.mesh.patches()[i].area * scene.weigh(solution.radiosity[i]);
  return {solution.mean_dropped * leaving, solution.largest_dropped * leaving};
}

/// What form factors lose, and by what: pairs left out, if that is most of it, or geometry beside them.
std::string lost_text(const scene::Scene& scene, const fem::RadiositySolution& solution, double lost, double noise) {
  const double emitted = scene.weigh(solution.energy.emitted);
  const auto part = [&](double flux) { return core::format_percent(flux / emitted); };
  const Dropped dropped = dropped_flux(scene, solution);
  const std::string loss = "form factors lose " + part(lost) + " of the emitted flux";
  if (!(dropped.about > 0)) return loss + coincidence;
  if (2 * dropped.about >= lost - noise)
    return loss + core::format(
                      ", likely by the pairs that --drop-below leaves out (%.2g of sum_j F_ij in the mean): a smaller "
                      "one leaves out less, and --closure makes up for it",
                      solution.mean_dropped);
  return loss + " (pairs that --drop-below leaves out: some " + part(dropped.about) + " of the emitted flux, at most " +
         part(dropped.most) + ")" + coincidence;
}

/// What the solution shows to be odd.
std::vector<std::string> warnings_of(const SolvedScene& solved) {
  std::vector<std::string> warnings = blind_sensors(solved);
  for (std::string& warning : energy_warnings(solved.scene, solved.solution)) warnings.push_back(std::move(warning));
  constexpr double noticeable = 1e-3;
  if (const double share = negative_share(solved); share > noticeable)
    warnings.push_back(
        core::format("polynomials dip below 0 at some %s of the surfaces, beside shadows that elements are "
                     "too large for%s",
                     core::format_percent(share).c_str(),
                     solved.solution.adaptation ? ": they were made for one number, not for pictures" : ""));
  return warnings;
}

}  // namespace

std::vector<std::string> energy_warnings(const scene::Scene& scene, const fem::RadiositySolution& solution) {
  std::vector<std::string> warnings;
  const double emitted = scene.weigh(solution.energy.emitted), on_backs = scene.weigh(solution.energy.on_backs);
  if (on_backs - normal_95 * scene.weigh(solution.energy.on_backs_error) > noticeable_on_backs * emitted)
    warnings.push_back("black backs absorb " + core::format_percent(on_backs / emitted) +
                       " of the emitted flux: is a surface flipped?  interflect check tells which");
  const double imbalance = scene.weigh(solution.energy.form_factor_error),
               noise = normal_95 * scene.weigh(solution.energy.split_error);
  if (std::abs(imbalance) - noise <= noticeable_imbalance * emitted) return warnings;
  warnings.push_back(imbalance > 0 ? lost_text(scene, solution, imbalance, noise)
                                   : "form factors make up " + core::format_percent(-imbalance / emitted) +
                                         " of the emitted flux" + coincidence);
  return warnings;
}

std::vector<std::string> shortfalls_of(const fem::RadiositySolution& solution, const fem::RadiositySettings& settings) {
  std::vector<std::string> warnings;
  if (!solution.tolerance_met)
    warnings.push_back(core::format(
        "some rows of form factors are less accurate than asked: sum_j |dF_ij| is up to %.1e, %.1e asked for",
        solution.largest_row_error, settings.row_tolerance));
  if (const auto& made = solution.adaptation;
      made && made->why != fem::AdaptiveStop::met && made->why != fem::AdaptiveStop::only_asked)
    warnings.push_back("elements for '" + made->goal.name + "': the error is larger than asked, since " +
                       describe(made->why));
  if (!solution.solver.converged())
    warnings.push_back("the solver has not converged: " + solvers::describe(solution.solver.why));
  return warnings;
}

std::vector<Estimate> answers_at(std::span<const measure::SensorPoint> points, const fem::RadiosityMethod& method,
                                 const scene::Scene& scene, Run& run) {
  std::vector<measure::Measurement> asked;
  for (const measure::SensorPoint& point : points) asked.emplace_back(point.at);
  return method.answer(scene, asked, run);
}

std::string describe(const fem::Forecast& forecast) {
  return core::format("%s elements, %s, about %s",
                      core::format_count(static_cast<unsigned long long>(forecast.elements)).c_str(),
                      core::format_bytes(forecast.bytes).c_str(), core::format_duration(forecast.seconds).c_str());
}

results::Record forecast_record(const fem::Forecast& forecast) {
  results::Record record;
  record.add("elements", static_cast<std::uint64_t>(forecast.elements));
  return record.add("bytes", forecast.bytes).add("seconds", forecast.seconds);
}

/// Not known where they are made for a goal.
static std::optional<double> elements_to_bound(const fem::Forecast& forecast, const SolveOptions& options) {
  return options.target_error > 0 ? std::nullopt : std::optional(forecast.elements);
}

scene::Scene scene_to_solve(const SolveOptions& options) {
  scene::Scene scene = read_to_solve(options.scene, SceneUse::light,
                                     options.bounds ? scene::Twice::nothing : scene::Twice::parts_of_a_surface);
  if (const auto smooth = fem::any_smooth(scene); smooth && (options.bounds || options.residual))
    throw core::InputError("'" + scene.surface(*smooth).name + "', a mirror or glass",
                           std::string("it does not go with ") + (options.bounds ? "--bounds" : "--residual") +
                               ", which know what is straight ahead alone");
  return scene;
}

ExitStatus print_forecast(const SolveOptions& options, const CommonOptions& common, const Run& run) {
  const scene::Scene scene = scene_to_solve(options);
  const fem::Forecast forecast = fem::forecast(scene, settings_of(options, scene, measure::sensor_points(scene)), run);
  results::Record record = forecast_record(forecast);
  std::string text = (options.target_error > 0 ? "first pass: " : "") + describe(forecast);
  if (options.bounds) {
    const std::optional<double> elements = elements_to_bound(forecast, options);
    if (elements) record.add("bounds_seconds", roughly_seconds_of_bounds(*elements, run.threads.count()));
    text += bounds_forecast_text(elements, run.threads.count());
  }
  std::printf("%s\n", common.json ? results::json_text(record).c_str() : text.c_str());
  return success;
}

/// Whether it is as far as a run came that was stopped, and as good as any: all else that belongs to it is to be there.
static bool is_part_of_more(const fem::RadiositySolution& solution) {
  using Stopped = solvers::SolverReport::Stopped;
  const auto& made = solution.adaptation;
  return (made && was_stopped(made->why)) || solution.solver.why == Stopped::asked_to ||
         solution.solver.why == Stopped::time_limit;
}

/// That it was stopped is said when that is asked; at the end it is said what that leaves.
static fem::RadiositySolution solution_of(const scene::Scene& scene, const fem::RadiositySettings& settings, Run& run) {
  try {
    return fem::solve_radiosity(scene, settings, run);
  } catch (const core::Interrupted&) {
    const bool samples = solvers::solver_named(settings.solver).samples();
    throw core::Interrupted(
        std::string("the solve, before there is a solution: nothing is written") +
        (samples ? "" : " (interflect shoot, or a --solver that samples, would have had something to keep)"));
  }
}

std::unique_ptr<SolvedScene> solve_scene(scene::Scene scene, const SolveOptions& options, const CommonOptions& common,
                                         Run& asked) {
  auto points = measure::sensor_points(scene);  // before the work: they are what else may be too much
  const fem::RadiositySettings settings = settings_of(options, scene, points);
  const fem::Forecast forecast = fem::forecast(scene, settings, asked);
  auto folder = std::make_unique<results::OutputDirectory>(options.out);
  if (!common.json && !common.quiet) {
    const std::string plan =
        options.target_error > 0
            ? core::format("elements are made for '%s' until its error is below %.2g %%; the first pass: ",
                           settings.adaptive->goal.name.c_str(), 100 * options.target_error)
            : "";
    std::printf("bounding box %s\n%s%s%s\n", box_text(scene).c_str(), plan.c_str(), describe(forecast).c_str(),
                options.bounds
                    ? bounds_forecast_text(elements_to_bound(forecast, options), asked.threads.count()).c_str()
                    : "");
  }
  std::fflush(stdout);
  auto solution = solution_of(scene, settings, asked);
  Run run = is_part_of_more(solution) ? asked.to_the_end() : asked;
  auto solved = std::make_unique<SolvedScene>(std::move(scene), forecast, std::move(solution));
  solved->folder = std::move(folder);
  solved->points = std::move(points);
  solved->rays = raycast::make_ray_caster(options.settings.intersector, solved->scene);
  solved->at_points = answers_at(solved->points, solved->method(), solved->scene, run);
  solved->warnings = lines_of(solved->scene.warnings);
  for (const std::string& warning : warnings_of(*solved)) {
    core::log::warning(warning);
    solved->warnings.push_back(warning);
  }
  for (const std::string& warning : shortfalls_of(solved->solution, settings)) {
    core::log::shortfall(warning);
    solved->warnings.push_back(warning);
  }
  return solved;
}

}  // namespace interflect::apps

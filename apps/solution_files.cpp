#include "apps/solution_files.h"

#include <cmath>

#include "apps/equation_residual.h"
#include "apps/goals.h"
#include "apps/leftovers.h"
#include "apps/proved_bounds.h"
#include "apps/read_scene.h"
#include "apps/smooth_field.h"
#include "apps/table.h"
#include "core/build_info.h"
#include "core/format.h"
#include "core/memory.h"
#include "fem/error_summary.h"
#include "mesh/bare_patches.h"
#include "photometry/sensor_summary.h"
#include "results/vtu.h"
#ifdef INTERFLECT_WITH_VTK
#include "apps/field_pictures.h"
#endif

namespace interflect::apps {
namespace {

/// Bytes are counted in whole ones.
std::uint64_t whole(double bytes) { return static_cast<std::uint64_t>(std::llround(bytes)); }

using fem::RadiositySolution;

/// Half the widths of 95 % intervals, by element.
std::vector<Spectrum> irradiance_errors(const RadiositySolution& solution) {
  std::vector<Spectrum> errors;
  for (std::size_t i = 0; i < solution.irradiance.size(); ++i)
    errors.push_back(solution.irradiance_error[i] + normal_95 * solution.irradiance_noise[i]);
  return errors;
}

/// The same of B = E + rho H.
std::vector<Spectrum> radiosity_errors(const RadiositySolution& solution, std::span<const Spectrum> of_irradiance) {
  std::vector<Spectrum> errors;
  for (std::size_t i = 0; i < of_irradiance.size(); ++i)
    errors.push_back(results::reflected_error(solution.reflectance[i], of_irradiance[i]));
  return errors;
}

void add_bounds(const fem::Enclosure& enclosure, const std::vector<std::string>& channels,
                std::vector<results::CellField>& fields) {
  const auto add = [&](const std::string& name, std::span<const Interval> bounds) {
    std::vector<Spectrum> lower, upper;
    for (const Interval& b : bounds) {
      lower.push_back(b.lower);
      upper.push_back(b.upper);
    }
    fields.push_back(results::spectrum_field(name + "_lower", lower, channels));
    fields.push_back(results::spectrum_field(name + "_upper", upper, channels));
  };
  add("irradiance", enclosure.irradiance());
  add("mean_irradiance", enclosure.mean_irradiance());
}

std::vector<results::CellField> fields_of(const SolvedScene& solved, results::BarePatches bare) {
  const RadiositySolution& s = solved.solution;
  const auto& channels = solved.scene.channels;
  std::vector<results::CellField> fields{
      results::spectrum_field("radiosity", s.radiosity, channels),
      results::spectrum_field("irradiance", s.irradiance, channels),
      results::spectrum_field("exitance", s.exitance, channels),
      results::spectrum_field("reflectance", s.reflectance, channels),
      results::spectrum_field("error", s.irradiance_error, channels),
      results::spectrum_field("noise", s.irradiance_noise, channels),
      results::spectrum_field("field_error", s.field_error, channels),
  };
  if (!s.row_sum.empty()) fields.push_back(results::scalar_field("row_sum", s.row_sum));
  if (solved.bounds) add_bounds(solved.bounds->enclosure, channels, fields);
  if (solved.residual) fields.push_back(results::spectrum_field("residual", solved.residual->of_elements, channels));
  for (results::CellField& ids : results::id_fields(s.mesh, bare)) fields.push_back(std::move(ids));
  return fields;
}

results::Record solver_record(const RadiositySolution& solution) {
  results::Record record;
  record.add("stopped", solvers::describe(solution.solver.why))
      .add("iterations", solution.solver.iterations())
      .add("rows_or_rays", solution.solver.rows())
      .add("residual", solution.solver.residual())
      .add("residual_history", solution.solver.residuals());
  return record;
}

results::Record energy_record(const fem::EnergyBalance& energy, int channels) {
  results::Record record;
  record.add("emitted", energy.emitted, channels)
      .add("absorbed", energy.absorbed, channels)
      .add("escaped", energy.escaped, channels)
      .add("on_backs", energy.on_backs, channels)
      .add("in_mirrors", energy.in_mirrors, channels)
      .add("split_standard_error", energy.split_error, channels)
      .add("form_factor_error", energy.form_factor_error, channels)
      .add("residual", energy.residual, channels);
  return record;
}

/// Sensors' means with their errors, in the weighted unit.
results::Record::List sensor_records(const SolvedScene& solved) {
  results::Record::List list;
  for (const auto& s : photometry::summarise(solved.scene, solved.points, solved.at_points)) {
    results::Record record;
    record.add("name", s.sensor)
        .add("points", s.points)
        .add("unit", solved.scene.irradiance_unit())
        .add("minimum", s.minimum)
        .add("mean", s.mean)
        .add("maximum", s.maximum)
        .add("uniformity", s.uniformity())
        .add("error", s.error)
        .add("minimum_error", s.minimum_error)
        .add("maximum_error", s.maximum_error)
        .add("uniformity_error", s.uniformity_error());
    if (solved.bounds) record.add("proved_error", proved_error(solved, *solved.bounds, s.sensor, s.mean));
    list.push_back(std::move(record));
  }
  return list;
}

std::string energy_text(const SolvedScene& solved) {
  const scene::Scene& scene = solved.scene;
  const fem::EnergyBalance& e = solved.solution.energy;
  const double emitted = scene.weigh(e.emitted);
  const auto part = [&](const Spectrum& flux) { return core::format_percent(scene.weigh(flux) / emitted); };
  const double noise = normal_95 * scene.weigh(e.split_error) / emitted;  // of rays that count what is lost
  const bool matrix = !solved.solution.row_sum.empty();
  std::string text =
      core::format("energy      emitted %.6g %s, absorbed %s, escaped %s, on black backs %s", emitted,
                   scene.flux_unit(), part(e.absorbed).c_str(), part(e.escaped).c_str(), part(e.on_backs).c_str());
  if (!e.in_mirrors.is_zero()) text += ", in mirrors and glass " + part(e.in_mirrors);
  if (matrix) text += ", form-factor error " + part(e.form_factor_error);
  if (matrix && noise > 0)
    text += core::format(" +- %.2g %% (noise of the rays that escape)", core::rounded_up(100 * noise, 2));
  return text + core::format(", left over %.1e%s\n", emitted > 0 ? std::abs(scene.weigh(e.residual)) / emitted : 0.0,
                             matrix ? "" : " (noise)");
}

/// What was asked of the matrix beside its entries: tolerance, threshold, repair.
std::string matrix_text(const RadiositySolution& s) {
  std::string text;
  if (s.largest_row_error > 0)
    text += core::format("row errors  sum_j |dF_ij| at most %.1e (estimated)\n", s.largest_row_error);
  if (s.kept_share < 1)
    text += core::format("kept        %s of the pairs; dropped sum_j F_ij: mean %.2e, at most %.2e\n",
                         core::format_percent(s.kept_share).c_str(), s.mean_dropped, s.largest_dropped);
  if (s.closure_correction > 0)
    text += core::format("closure     form factors changed by %.2e of their norm\n", s.closure_correction);
  if (!s.environment.empty())
    text += core::format("environment %s of what leaves elements, if all sent the same\n",
                         core::format_percent(fem::mean_environment(s)).c_str());
  return text;
}

}  // namespace

results::Record settings_record(const fem::RadiositySettings& settings, const RadiositySolution& solution) {
  results::Record record;
  record.add("element_size_m", solution.element_size)
      .add("form_factors", solution.form_factors.empty() ? settings.form_factors : solution.form_factors)
      .add("order", settings.order)
      .add("projection", fem::name_of(settings.projection))
      .add("solver", settings.solver)
      .add("solver_tolerance", settings.stopping.tolerance)
      .add("noise", settings.stopping.noise)
      .add("sequence", settings.solver_settings.sequence)
      .add("replications", settings.solver_settings.replications)
      .add("intersector", settings.intersector)
      .add("quadrature_tolerance", settings.quadrature_tolerance)
      .add("row_tolerance", settings.row_tolerance)
      .add("visibility_rays", settings.visibility_rays)
      .add("visibility_error", settings.visibility_error)
      .add("samples", settings.samples)
      .add("resolution", settings.resolution)
      .add("drop_below", settings.drop_below)
      .add("closure", settings.closure)
      .add("max_memory_bytes", whole(settings.max_memory));
  return record;
}

results::Record form_factor_record(const RadiositySolution& solution) {
  results::Record record;
  record.add("pairs_facing_away", solution.pairs.facing_away)
      .add("pairs_clear", solution.pairs.clear)
      .add("pairs_sampled", solution.pairs.sampled)
      .add("rays", solution.pairs.rays)
      .add("clamped", solution.pairs.clamped);
  if (!solution.row_sum.empty())
    record.add("row_sum_mean", solution.rows.mean)
        .add("row_sum_lowest", solution.rows.lowest)
        .add("row_sum_highest", solution.rows.highest);
  record.add("largest_row_error", solution.largest_row_error)
      .add("tolerance_met", solution.tolerance_met)
      .add("kept_share", solution.kept_share)
      .add("dropped_mean", solution.mean_dropped)
      .add("dropped_highest", solution.largest_dropped)
      .add("closure_correction", solution.closure_correction)
      .add("environment_mean", fem::mean_environment(solution));
  return record;
}

results::Record summary_record(const SolvedScene& solved, const SolveOptions& options, const CommonOptions& common,
                               const Run& run) {
  const RadiositySolution& solution = solved.solution;
  const int channels = solved.scene.channel_count();
  const core::BuildInfo build = core::build_info();
  const fem::ErrorSummary error = fem::summarise_error(solution, solved.scene);
  results::Record seconds, peaks, record;
  for (const fem::StageCost& stage : solution.stages) {
    seconds.add(stage.stage, stage.seconds);
    peaks.add(stage.stage, whole(stage.peak_bytes));
  }
  record.add("version", build.version)
      .add("build", build.compiler)
      .add("command", common.command_line)
      .add("scene", solved.scene.file.string())
      .add("seed", common.seed)
      .add("threads", run.threads.count())
      .add("quantity", solved.scene.quantity == scene::Quantity::photometric ? "photometric" : "radiometric")
      .add("channels", solved.scene.channels)
      .add("weights", solved.scene.weights, channels)
      .add("settings", settings_record(options.settings, solution))
      .add("forecast", forecast_record(solved.forecast))
      .add("elements", solution.mesh.size())
      .add("operator_bytes", whole(solution.bytes))
      .add("seconds", std::move(seconds))
      .add("peak_memory_bytes_by_stage", std::move(peaks))
      .add("form_factors", form_factor_record(solution))
      .add("solver", solver_record(solution))
      .add("energy", energy_record(solution.energy, channels))
      .add("mean_irradiance", error.mean_irradiance)
      .add("mean_irradiance_error", error.mean_error)
      .add("relative_error_l2", error.relative_l2)
      .add("relative_noise_l2", error.relative_noise_l2)
      .add("sensors", sensor_records(solved))
      .add("adaptation",
           solution.adaptation ? adaptation_record(*solution.adaptation, solved.scene) : results::Record())
      .add("bounds", solved.bounds ? bounds_record(solved, *solved.bounds) : results::Record())
      .add("residual", solved.residual ? residual_record(solved, *solved.residual) : results::Record())
      .add("repairs", lines_of(solved.scene.repairs))
      .add("warnings", solved.warnings)
      .add("stopped", run.stop.stop_requested())
      .add("peak_memory_bytes", whole(core::peak_memory_bytes()));
  return record;
}

void write_summary(const SolvedScene& solved, const SolveOptions& options, const CommonOptions& common,
                   const Run& run) {
  results::write_json(options.out / "summary.json", summary_record(solved, options, common, run));
}

void write_field(const SolvedScene& solved, const std::filesystem::path& folder, [[maybe_unused]] bool pictures) {
  const RadiositySolution& s = solved.solution;
  const auto field = smooth_field(s);
  std::vector<std::string> not_written;
  if (!field) not_written.emplace_back("solution_smooth");
  if (!solved.bounds || !pictures) not_written.emplace_back("bounds");
  if (!pictures) not_written.insert(not_written.end(), {"radiosity", "irradiance"});
  remove_leftovers(folder, not_written);
  const std::vector<scene::SurfacePatch> bare = mesh::bare_patches(solved.scene, s.mesh);
  results::write_vtu(folder / "solution.vtu", s.mesh, fields_of(solved, bare), bare);
  if (field) write_smooth_field(folder / "solution_smooth.vtu", *field, solved.scene);
#ifdef INTERFLECT_WITH_VTK
  if (pictures) write_field_pictures(solved, field ? &*field : nullptr, folder);
#endif
}

void write_tables_and_field(const SolvedScene& solved, const std::filesystem::path& folder, bool pictures) {
  const RadiositySolution& s = solved.solution;
  const std::vector<Spectrum> of_irradiance = irradiance_errors(s), of_radiosity = radiosity_errors(s, of_irradiance);
  results::write_surfaces_csv(
      folder / "surfaces.csv",
      results::surface_means(solved.scene, s.mesh, {s.radiosity, s.irradiance, of_radiosity, of_irradiance}),
      solved.scene);
  results::write_sensors_csv(
      folder / "sensors.csv", solved.points, solved.at_points, solved.scene,
      solved.bounds ? std::span<const Interval>(solved.bounds->at_points) : std::span<const Interval>());
  write_field(solved, folder, pictures);
}

void write_solution(const SolvedScene& solved, const SolveOptions& options, const CommonOptions& common,
                    const Run& run) {
  std::vector<std::string> later{"validation", "traced_surfaces", "traced_sensors"};
  if (!options.settings.light_groups) later.emplace_back("light_groups");
  remove_leftovers(options.out, later);
  write_summary(solved, options, common, run);
  write_tables_and_field(solved, options.out, options.pictures);
}

std::string mean_line(const SolvedScene& solved) {
  const fem::ErrorSummary error = fem::summarise_error(solved.solution, solved.scene);
  std::optional<double> proved;
  if (solved.bounds) proved = proved_error(solved, *solved.bounds, error.mean_irradiance);
  return goal_line("E_avg(all surfaces)", error.mean_irradiance, error.mean_error, solved.scene.irradiance_unit(),
                   proved) +
         "\n";
}

std::string means_text(const SolvedScene& solved) {
  if (solved.points.empty()) return "\n" + mean_line(solved);
  const std::string unit = solved.scene.irradiance_unit();
  const fem::Goal* goal = solved.solution.adaptation ? &solved.solution.adaptation->goal : nullptr;
  Table table({"sensor", "points", "min " + unit, "mean " + unit, "max " + unit, "U0"});
  std::string means = mean_line(solved);
  for (const auto& s : photometry::summarise(solved.scene, solved.points, solved.at_points)) {
    const auto with_error = [](double value, double error) {
      return core::format("%.4g +- %.2g", value, core::rounded_up(error, 2));
    };
    table.add({s.sensor, std::to_string(s.points), with_error(s.minimum, s.minimum_error), core::format("%.5g", s.mean),
               with_error(s.maximum, s.maximum_error),
               core::format("%.2f +- %.2g", s.uniformity(), core::rounded_up(s.uniformity_error(), 1))});
    if (goal && goal->name == s.sensor && !solved.bounds) continue;  // which is known better (adaptation_text)
    std::optional<double> proved;
    if (solved.bounds) proved = proved_error(solved, *solved.bounds, s.sensor, s.mean);
    means += goal_line("E_avg(" + s.sensor + ")", s.mean, s.error, unit.c_str(), proved) + "\n";
  }
  return "\n" + table.text() + "\n" + means;
}

std::string irradiance_text(const SolvedScene& solved) {
  const fem::ErrorSummary error = fem::summarise_error(solved.solution, solved.scene);
  const bool matrix = !solved.solution.row_sum.empty();
  return core::format("irradiance  elements are off by %s %s (L2, estimated) and have noise of %s\n",
                      matrix ? "about" : "at most about", core::format_percent(error.relative_l2).c_str(),
                      core::format_percent(error.relative_noise_l2).c_str());
}

/// @param samples  its residual is noise
std::string solver_text(const solvers::SolverReport& report, bool samples) {
  const std::string why = solvers::describe(report.why);
  if (report.why == solvers::SolverReport::Stopped::nothing_to_do)
    return "solver      " + why + ": nothing was computed, and all is dark\n";
  if (samples)
    return core::format("solver      %s after %d rounds and %s rays, standard error %s (L2) of what is reflected\n",
                        why.c_str(), report.iterations(),
                        core::format_count(static_cast<unsigned long long>(report.rows())).c_str(),
                        core::format_percent(report.residual()).c_str());
  return core::format("solver      %s after %d iterations, residual %.1e\n", why.c_str(), report.iterations(),
                      report.residual());
}

std::string solution_text(const SolvedScene& solved) {
  const RadiositySolution& s = solved.solution;
  std::string text = core::format("\nelements    %s, edges up to %.4g m, %s\n",
                                  core::format_count(static_cast<unsigned long long>(s.mesh.size())).c_str(),
                                  s.mesh.longest_edge(), core::format_bytes(s.bytes).c_str());
  text += energy_text(solved);
  if (!s.row_sum.empty())
    text += core::format("rows        sum_j F_ij: mean %.6f, from %.6f to %.6f\n", s.rows.mean, s.rows.lowest,
                         s.rows.highest);
  text += matrix_text(s);
  text += irradiance_text(solved);
  if (s.row_sum.empty() && !s.solver.history.empty())
    text += core::format(
        "            no matrix tells what smaller elements would change: what %s\n"
        "            stands for it, which more rays do not lower\n",
        s.field ? "polynomials of the highest degree bring" : "light varies by inside these");
  if (solved.bounds) text += bounds_text(solved, *solved.bounds);
  if (solved.residual) text += residual_text(solved, *solved.residual);
  text += solver_text(s.solver, s.row_sum.empty());
  text += "time        ";
  for (const fem::StageCost& stage : s.stages)
    text += core::format("%s %s  ", stage.stage.c_str(), core::format_duration(stage.seconds).c_str());
  text += "\n" + means_text(solved);
  if (s.adaptation) text += "\n" + adaptation_text(*s.adaptation, solved.scene);
  return text;
}

}  // namespace interflect::apps

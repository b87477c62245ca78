#include <cstdio>
#include <memory>
#include <optional>

#include "apps/commands.h"
#include "apps/pictures.h"
#include "apps/questions.h"
#include "apps/solution_files.h"
#include "apps/validation_files.h"
#include "core/error.h"
#include "core/format.h"
#include "montecarlo/integrators.h"
#include "montecarlo/path_tracer.h"

namespace interflect::apps {
namespace {

using validation::Certificate;
using validation::Judged;

constexpr double accuracy_of_norms =
    3;  ///< the reference's 95 % error may be this many times the accuracy asked of a value

/// Both methods' answers, as mean irradiances, in the order of the questions.
std::vector<Judged> judge(const SolvedScene& solved, const Questions& questions, const measure::Method& tracer,
                          Run& run) {
  const std::vector<Estimate> fem = solved.method().answer(solved.scene, questions.asked, run);
  const std::vector<Estimate> mc = tracer.answer(solved.scene, questions.asked, run);
  std::vector<Judged> judged = questions.judged;
  for (std::size_t k = 0; k < judged.size(); ++k) {
    const double per_area = std::holds_alternative<measure::Flux>(questions.asked[k]) ? 1 / judged[k].area : 1;
    judged[k].fem = scaled(fem[k], per_area);
    judged[k].mc = scaled(mc[k], per_area);
  }
  return judged;
}

validation::EnergyBalance fem_energy(const fem::EnergyBalance& e) {
  validation::EnergyBalance out;
  out.emitted = e.emitted;
  out.absorbed = e.absorbed;
  out.lost = e.emitted - e.absorbed - e.residual;
  out.on_backs = e.on_backs;
  out.residual = e.residual;
  out.standard_error = e.split_error;
  return out;
}

validation::EnergyBalance traced_energy(const SolvedScene& solved, std::span<const Judged> judged) {
  std::vector<double> areas;
  std::vector<Spectrum> reflectances;
  std::vector<Estimate> irradiance;
  for (std::size_t k = 0; k < solved.solution.mesh.parts().size(); ++k) {
    const mesh::ElementMesh::Part& part = solved.solution.mesh.parts()[k];
    areas.push_back(judged[k].area);
    reflectances.push_back(solved.scene.material(part.surface).reflectance_of(part.side));
    irradiance.push_back(judged[k].mc);
  }
  return validation::sampled_energy(solved.scene.emitted_flux(), areas, reflectances, irradiance);
}

Certificate certified(const SolvedScene& solved, std::span<const Judged> judged, double accuracy, const Run& run) {
  validation::Settings settings;
  settings.reference_limit = accuracy_of_norms * accuracy;
  Certificate certificate = validation::certify(solved.scene, judged, fem_energy(solved.solution.energy),
                                                traced_energy(solved, judged), settings);
  const solvers::SolverReport& solver = solved.solution.solver;
  if (!solver.converged()) add_reason("the solver has not converged: " + solvers::describe(solver.why), certificate);
  if (run.stop.stop_requested()) add_reason("stopped before every traced value was as accurate as asked", certificate);
  return certificate;
}

std::unique_ptr<measure::Method> tracer_for(const ValidateOptions& options) {
  montecarlo::IntegratorSettings settings;
  settings.target = options.accuracy;
  settings.intersector = options.solve.settings.intersector;
  return montecarlo::make_integrator(options.integrator, settings);
}

/// Without a bias, and of all paths that radiosity finds: else a difference would say nothing.
void require_reference(const ValidateOptions& options) {
  if (montecarlo::integrator_entry(options.integrator).needs_solution)
    throw core::InputError("integrator '" + options.integrator + "'",
                           "one expected that knows nothing of a radiosity solution, which it is to check");
  const measure::Capabilities finds = tracer_for(options)->capabilities();
  for (const measure::PathClasses* each : {&finds.to_patches, &finds.to_points})
    if (const auto missed = measure::PathClasses::of("A(D|S)*E") - *each; !finds.unbiased || !missed.empty())
      throw core::InputError("integrator '" + options.integrator + "'",
                             "an unbiased one expected that finds all that radiosity does, A(D|S)*E" +
                                 (missed.empty() ? "" : ", also " + missed.shortest()));
}

/// By a trial of a few of them; of path tracing alone.
std::optional<double> tracing_seconds(const scene::Scene& scene, const Questions& questions,
                                      const ValidateOptions& options, Run& run) {
  if (options.integrator != "path") return std::nullopt;
  montecarlo::PathTracerSettings settings;
  settings.target = options.accuracy;
  settings.intersector = options.solve.settings.intersector;
  return montecarlo::PathTracer(settings).forecast(scene, questions.asked, run);
}

Questions questions_of(const scene::Scene& scene, const mesh::ElementMesh& mesh,
                       std::span<const measure::SensorPoint> points, const ValidateOptions& options,
                       std::uint64_t seed) {
  const auto all = static_cast<std::size_t>(mesh.size()), some = static_cast<std::size_t>(options.elements);
  return questions_about(scene, mesh, points, options.all_elements ? all : some, seed);
}

std::string tracing_text(const Questions& questions, const ValidateOptions& options, std::optional<double> seconds) {
  return core::format("tracing %s measurements to %.2g %%%s", core::format_count(questions.asked.size()).c_str(),
                      100 * options.accuracy,
                      (seconds ? ", about " + core::format_duration(*seconds) : " by " + options.integrator).c_str());
}

/// With --forecast, what the solve and the tracing will need is the result; the pictures come on top.
ExitStatus print_forecast(const ValidateOptions& options, const CommonOptions& common, Run& run) {
  const scene::Scene scene = scene_to_solve(options.solve);
  const fem::Forecast solve = fem::forecast(scene, options.solve.settings, run);
  const mesh::ElementMesh mesh = fem::elements_of(scene, options.solve.settings);
  const Questions questions = questions_of(scene, mesh, measure::sensor_points(scene), options, run.seed);
  const std::optional<double> seconds = tracing_seconds(scene, questions, options, run);
  results::Record record = forecast_record(solve);
  record.add("measurements", static_cast<std::uint64_t>(questions.asked.size()));
  if (seconds) record.add("tracing_seconds", *seconds);
  std::printf("%s\n", common.json ? results::json_text(record).c_str()
                                  : (describe(solve) + "; then " + tracing_text(questions, options, seconds)).c_str());
  return success;
}

/// Asks both methods; where a stop leaves nothing to judge by, summary.json tells of it.
std::vector<Judged> trace_and_judge(const SolvedScene& solved, const ValidateOptions& options,
                                    const CommonOptions& common, Run& run) try {
  const Questions questions = questions_of(solved.scene, solved.solution.mesh, solved.points, options, run.seed);
  if (!common.json && !common.quiet)
    std::printf("\n%s\n",
                tracing_text(questions, options, tracing_seconds(solved.scene, questions, options, run)).c_str());
  std::fflush(stdout);
  return judge(solved, questions, *tracer_for(options), run);
} catch (const core::Interrupted&) {
  write_summary(solved, options.solve, common, run);
  throw;
}

}  // namespace

ExitStatus validate(const ValidateOptions& options, const CommonOptions& common, Run& run) {
  require_reference(options);  // before the work
  if (options.solve.forecast_only) return print_forecast(options, common, run);
  const auto solved = solve_scene(scene_to_solve(options.solve), options.solve, common, run);
  write_solution(*solved, options.solve, common, run);
  const bool talk = !common.json && !common.quiet;
  if (talk) std::printf("%s", solution_text(*solved).c_str());

  const std::vector<Judged> judged = trace_and_judge(*solved, options, common, run);
  const Certificate certificate = certified(*solved, judged, options.accuracy, run);
  write_traced(*solved, judged, certificate, options.solve.out);
  results::Record record = write_records(*solved, judged, certificate, options, common, run);
  if (talk) std::printf("%s\n", certificate_text(certificate).c_str());
  std::fflush(stdout);
  if (options.solve.pictures) write_comparisons(*solved, options, run);
  if (run.stop.stop_requested()) record = write_records(*solved, judged, certificate, options, common, run);

  if (common.json) std::printf("%s\n", results::json_text(record).c_str());
  if (talk) std::printf("written to %s\n", options.solve.out.string().c_str());
  return certificate.passed && !run.stop.stop_requested() ? success : not_met;
}

}  // namespace interflect::apps

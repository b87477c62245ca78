#include "fem/radiosity.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/format.h"
#include "core/log.h"
#include "fem/assembly.h"
#include "fem/closure.h"
#include "fem/columns.h"
#include "fem/dark_solution.h"
#include "fem/element_materials.h"
#include "fem/energy.h"
#include "fem/error_estimate.h"
#include "fem/goal/adaptive_elements.h"
#include "fem/node_radiosity.h"
#include "fem/polynomial_radiosity.h"
#include "fem/radiosity_operator.h"
#include "fem/row_sum_check.h"
#include "fem/sampled_radiosity.h"
#include "fem/specular/channel_by_channel.h"
#include "fem/specular/light_caster.h"
#include "fem/specular/specular_chains.h"
#include "fem/specular/specular_settings.h"
#include "fem/stage_clock.h"
#include "measure/light_groups.h"

namespace interflect::fem {

namespace {

/// What is solved, and by which rays.
struct Problem {
  const scene::Scene& scene;
  const RadiositySettings& settings;
  const raycast::RayCaster& rays;
};

/// b = e + R G^-1 K b from a fresh start.
solvers::ColumnMatrix solve_system(const SymmetricOperator& K, const solvers::ColumnMatrix& exitance,
                                   const solvers::ColumnMatrix& reflectance, const RadiositySettings& settings,
                                   Run& run, solvers::SolverReport& report) {
  const solvers::Reflection R(reflectance);
  solvers::SolverState state{exitance};
  report = solver_of(settings)->advance({K, R, exitance}, state, settings.stopping, run);
  return std::move(state.x);
}

/// Every fourth row: the parents' values of what four children share.
solvers::ColumnMatrix of_parents(const solvers::ColumnMatrix& children) {
  solvers::ColumnMatrix parents(children.rows() / 4, children.cols());
  for (Index I = 0; I < parents.rows(); ++I) parents.row(I) = children.row(4 * I);
  return parents;
}
solvers::ColumnMatrix to_children(const solvers::ColumnMatrix& parents) {
  solvers::ColumnMatrix children(4 * parents.rows(), parents.cols());
  for (Index i = 0; i < children.rows(); ++i) children.row(i) = parents.row(i / 4);
  return children;
}

RowSums summary_of(std::span<const double> row_sums, std::span<const double> areas) {
  RowSums rows{0, row_sums.front(), row_sums.front()};
  double area = 0;
  for (std::size_t i = 0; i < row_sums.size(); ++i) {
    rows.mean += areas[i] * row_sums[i];
    area += areas[i];
    rows.lowest = std::min(rows.lowest, row_sums[i]);
    rows.highest = std::max(rows.highest, row_sums[i]);
  }
  rows.mean /= area;
  return rows;
}

/// Radiosity on the elements and on elements of twice the size, whose K is the sum of the children's, and irradiance.
/// A solve that is stopped ends with what it has, and nothing is asked of larger elements then.
/// @return  whether both solves converged
bool solve_both(RadiositySolution& s, const scene::Scene& scene, const SymmetricOperator& K,
                const RadiositySettings& settings, Run& run) {
  const int channels = scene.channel_count();
  const solvers::ColumnMatrix e = to_columns(s.exitance, channels), rho = to_columns(s.reflectance, channels);
  Run rest = run.to_the_end();
  solvers::ColumnMatrix B, H(e.rows(), e.cols());
  if (settings.projection == Projection::galerkin) {
    B = solve_system(K, e, rho, settings, run, s.solver);
    K.apply(B, H, rest);
    divide_by(H, K.gram());
  } else {
    ElementFields fields =
        solve_at_nodes(node_equations(settings.projection, scene, s.mesh, 0, K, run), s, settings, channels, run);
    B = std::move(fields.radiosity);
    H = std::move(fields.irradiance);
    s.solver = std::move(fields.report);
  }
  s.radiosity = to_spectra(B);
  s.irradiance = to_spectra(H);
  if (run.stop.stop_requested()) {
    s.coarse_radiosity = means_of_fours(s.mesh, s.radiosity);
    return false;
  }
  solvers::SolverReport of_coarse;
  const auto coarse = aggregated(K, rest);
  s.coarse_radiosity =
      to_spectra(to_children(solve_system(*coarse, of_parents(e), of_parents(rho), settings, run, of_coarse)));
  return s.solver.converged() && of_coarse.converged();
}

/// Whether no ray that leaves an element, chosen by area, is lost.
bool is_closed(const RadiositySolution& s, const Problem& problem, Run& run) {
  const std::vector<Spectrum> by_area_alone(s.exitance.size());
  return cast_lost_rays(problem.scene, s.mesh.patches(), by_area_alone, problem.rays, run).lost == 0;
}

/// Row sums repaired where that was asked for; an open scene's with `environment`.
void close(RadiositySolution& s, RadiosityOperator& from, const EnvironmentColumn* environment,
           const RadiositySettings& settings, Run& run) {
  if (settings.closure == "none") return;
  ClosureSettings closure;
  closure.method = settings.closure;
  closure.row_bound = from.row_bound;
  closure.environment = environment;
  ClosureReport report = restore_closure(*from.K, run, closure);
  s.closure_correction = report.correction;
  s.environment = std::move(report.environment);
}

void set_operator_record(RadiositySolution& s, const RadiosityOperator& from) {
  const SymmetricOperator& K = *from.K;
  s.pairs = from.pairs;
  s.largest_row_error = from.largest_row_error;
  s.tolerance_met = from.tolerance_met;
  s.bytes = K.bytes() + (from.blocks ? from.blocks->bytes() : 0);
  s.kept_share = K.kept_share();
  if (K.dropped().empty()) return;
  const RowSums dropped = summary_of(K.dropped(), K.gram());
  s.largest_dropped = dropped.highest;
  s.mean_dropped = dropped.mean;
}

void balance_energy(RadiositySolution& s, const Problem& problem, Run& run) {
  const LostRays lost = cast_lost_rays(problem.scene, s.mesh.patches(), s.radiosity, problem.rays, run);
  if (s.closed && lost.lost > 0) {
    s.closed = false;
    if (problem.settings.closure != "none")
      core::log::warning("closure was restored, but a few rays do leave the scene: its openings are small, not absent");
  }
  s.energy = energy_balance(s, lost);
}

}  // namespace

namespace {

void require_compatible_projection(const RadiositySettings& settings) {
  if (settings.projection == Projection::galerkin) return;
  const auto refuse = [](const std::string& what) {
    throw core::InputError("unknowns that are values at nodes", "they do not go with " + what);
  };
  if (settings.adaptive) refuse("elements made for a goal");
  if (solvers::solver_named(settings.solver).needs != solvers::SolverEntry::Needs::products)
    refuse("solver '" + settings.solver + "', which wants more than products: 'automatic' or 'gmres' would do");
  if (settings.projection == Projection::centroids && settings.order != 0)
    refuse("polynomials: at centroids there are constants, of order 0");
  if (at_corners(settings.projection) && settings.order != 1)
    refuse(core::format("order %d: between corners there are linear functions, of order 1", settings.order));
  if (settings.closure != "none") refuse("a closure that is restored");
  if (settings.drop_below > 0) refuse("pairs left out (drop-below)");
  if (settings.stored_factors) refuse("view factors of a file");
}

}  // namespace

int order_of_blocks(const RadiositySettings& settings, std::span<const scene::SurfacePatch> patches) {
  const bool any_quad = std::any_of(patches.begin(), patches.end(), [](const auto& p) { return p.corners == 4; });
  return at_corners(settings.projection) && any_quad ? 2 : settings.order;
}

std::unique_ptr<solvers::RadiositySolver> solver_of(const RadiositySettings& settings) {
  return solvers::make_solver(settings.solver, settings.solver_settings);
}

void require_compatible(const RadiositySettings& settings) {
  if (solvers::solver_named(settings.solver).samples()) return require_sampled(settings);
  if (settings.adaptive && (settings.order < 1 || settings.order > 2))
    throw core::InputError(core::format("polynomials of order %d", settings.order),
                           "elements are made for a goal with order 1 or 2");
  if (settings.adaptive && settings.form_factors != "analytic")
    throw core::InputError(
        "form factors by " + settings.form_factors,
        "elements are made for a goal by analytic ones, which have no noise: --form-factors analytic");
  require_compatible_projection(settings);
  if (settings.order == 0) return;
  const auto refuse = [&](const std::string& what) {
    throw core::InputError(core::format("polynomials of order %d", settings.order), "they do not go with " + what);
  };
  if (settings.closure != "none") refuse("a closure that is restored");
  if (settings.drop_below > 0) refuse("pairs left out (drop-below)");
  if (settings.stored_factors) refuse("view factors of a file, which are of constants");
  if (settings.row_tolerance > 0)
    refuse("a tolerance of rows; those of entries (quadrature-tolerance, visibility-error) hold for theirs");
}

double mean_environment(const RadiositySolution& s) {
  double sum = 0, area = 0;
  for (std::size_t i = 0; i < s.environment.size(); ++i) {
    sum += s.mesh.patches()[i].area * s.environment[i];
    area += s.mesh.patches()[i].area;
  }
  return area > 0 ? sum / area : 0.0;
}

namespace {

/// Elements and their form factors.
struct Elements {
  mesh::ElementMesh mesh;
  std::vector<int> degree;  ///< of polynomials on elements, where they differ; else empty
  RadiosityOperator from;
  std::optional<Adaptation> adaptation;
};

Elements elements_with_factors(const Problem& problem, StageClock& timed, Run& run) {
  const scene::Scene& scene = problem.scene;
  const RadiositySettings& settings = problem.settings;
  if (settings.adaptive)
    return timed("adaptive elements", [&]() -> Elements {
      AdaptedElements made = adapt_elements(scene, settings, *settings.adaptive, problem.rays, run);
      return {std::move(made.mesh), std::move(made.degree), std::move(made.from), std::move(made.adaptation)};
    });
  mesh::ElementMesh mesh = timed("mesh", [&] { return elements_of(scene, settings); });
  if (mesh.size() == 0) throw core::InputError("the scene has no surface that light could leave");
  require_outside_glass(scene, mesh.patches(), *raycast::make_ray_caster(settings.intersector, scene), run);
  RadiositySettings of_blocks = settings;
  of_blocks.order = order_of_blocks(settings, mesh.patches());
  RadiosityOperator from =
      timed("form factors", [&] { return assemble_operator(scene, mesh.patches(), problem.rays, of_blocks, run); });
  return {std::move(mesh), {}, std::move(from), std::nullopt};
}

/// The elements with their materials, still without radiosity.
RadiositySolution unsolved(Elements& elements, const Problem& problem) {
  const double size =
      problem.settings.adaptive ? elements.mesh.longest_edge() : element_size_of(problem.scene, problem.settings);
  RadiositySolution s(std::move(elements.mesh), size);
  s.adaptation = std::move(elements.adaptation);
  s.form_factors = problem.settings.stored_factors ? "" : problem.settings.form_factors;
  ElementMaterials materials = materials_of(problem.scene, s.mesh.patches());
  s.exitance = std::move(materials.exitance);
  s.reflectance = std::move(materials.reflectance);
  set_operator_record(s, elements.from);
  return s;
}

/// What rows were before closure was restored, and what it was told of an open scene's openings.
struct Rows {
  std::vector<double> sum_before;
  std::optional<EnvironmentColumn> environment;

  const EnvironmentColumn* beyond() const { return environment ? &*environment : nullptr; }
};

/// Finds out whether the scene is closed, and restores closure where that was asked for.
void close_rows(RadiositySolution& s, RadiosityOperator& from, const Problem& problem, Rows& rows, Run& run) {
  const auto& [scene, settings, rays] = problem;
  const bool repair = settings.closure != "none";
  s.closed = is_closed(s, problem, run);
  if (repair && !s.closed)
    rows.environment = cast_environment_column(scene, s.mesh.patches(), rays, settings.environment_rays, run);
  close(s, from, rows.beyond(), settings, run);
  s.row_sum = repair ? from.K->row_sums(run) : rows.sum_before;
}

/// A scene's equations, whatever shines.
struct Equations {
  const Problem& of;
  const RadiosityOperator& from;
  std::span<const int> degree;  ///< of polynomials on elements, where they differ
  const Rows& rows;
};

/// What a solve leaves for the estimate of its error.
struct Found {
  bool converged;
  PolynomialChange change;  ///< of polynomials
};

Found solve_with(const Equations& equations, RadiositySolution& s, Run& run) {
  const auto& [scene, settings, rays] = equations.of;
  if (settings.order == 0) return {solve_both(s, scene, *equations.from.K, settings, run), {}};
  RadiositySettings of_blocks = settings;
  of_blocks.order = order_of_blocks(settings, s.mesh.patches());
  PolynomialChange change = solve_polynomials(s, scene, *equations.from.blocks, equations.degree, of_blocks, run);
  const bool converged = change.converged;
  return {converged, std::move(change)};
}

void estimate_with(const Equations& equations, const Found& found, RadiositySolution& s, Run& run) {
  const RadiositySettings& settings = equations.of.settings;
  const bool counted = settings.row_tolerance > 0 || settings.stored_factors;
  estimate_errors(
      s,
      {*equations.from.K, equations.from.blocks.get(), equations.rows.sum_before, settings.quadrature_tolerance,
       equations.from.beyond_tolerance, counted ? equations.from.row_bound : std::span<const double>(),
       equations.rows.beyond(), found.converged, settings.order > 0 ? &found.change : nullptr},
      equations.of.scene.channel_count(), run);
}

/// What a light group does alone.  @param dark  a solution without light
RadiositySolution solution_of(const std::string& group, const Equations& equations, const RadiositySolution& dark,
                              Run& run) {
  RadiositySolution s = dark;
  leave_group_alone(s.exitance, group, equations.of.scene, s.mesh.patches());
  const Found found = solve_with(equations, s, run);
  Run rest = run.to_the_end();
  estimate_with(equations, found, s, rest);
  return s;
}

RadiositySolution solve_by_factors(const scene::Scene& scene, const RadiositySettings& settings, Run& asked) {
  std::vector<StageCost> stages;
  StageClock timed(stages);
  const auto rays = timed("ray tree", [&] { return make_light_caster(settings.intersector, scene, asked.seed); });
  const Problem problem{scene, settings, *rays};
  Elements elements = elements_with_factors(problem, timed, asked);
  const bool passes_stopped = elements.adaptation && was_stopped(elements.adaptation->why);
  Run run = passes_stopped ? asked.to_the_end() : asked;  // to the end with the elements that there are
  RadiosityOperator& from = elements.from;
  RadiositySolution s = unsolved(elements, problem);
  Rows rows{from.K->row_sums(run), std::nullopt};
  timed("closure", [&] { close_rows(s, from, problem, rows, run); });
  s.rows = summary_of(s.row_sum, from.K->gram());
  require_row_sums(scene, s.mesh.patches(), s.row_sum, *from.K, run);
  RadiositySolution dark = settings.light_groups ? s : RadiositySolution(mesh::ElementMesh({}), 0);  // but for lights
  const Equations equations{problem, from, elements.degree, rows};
  const Found found = timed("solve", [&] { return solve_with(equations, s, run); });
  Run rest = run.to_the_end();  // what there is is written, however soon the solve was stopped
  timed("error estimate", [&] { estimate_with(equations, found, s, rest); });
  if (settings.light_groups)
    timed("light groups", [&] {
      for (const std::string& group : measure::light_groups(scene))
        s.of_groups.push_back(solution_of(group, equations, dark, run));
    });
  timed("energy balance", [&] { balance_energy(s, problem, rest); });
  s.stages = std::move(stages);
  return s;
}

/// Also of one channel of several, whose solutions have the same parts whether there is light in it or not.
RadiositySolution solve_one_way(const scene::Scene& scene, const RadiositySettings& settings, Run& run) {
  if (solvers::solver_named(settings.solver).samples()) return sample_radiosity(scene, settings, run);
  return solve_by_factors(scene, settings, run);
}

}  // namespace

RadiositySolution solve_radiosity(const scene::Scene& scene, const RadiositySettings& given, Run& run) {
  const RadiositySettings settings = with_mirrors_seen(scene, given);
  require_solvable(scene, settings);
  require_compatible(settings);
  if (is_dark(scene)) return dark_solution(scene, settings, run);
  if (any_smooth(scene) && !are_smooth_ones_grey(scene))
    return channel_by_channel(scene, settings.light_groups,
                              [&](const scene::Scene& one) { return solve_one_way(one, settings, run); });
  return solve_one_way(scene, settings, run);
}

}  // namespace interflect::fem

#include "apps/option_groups.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <limits>

#include "apps/heeded_options.h"
#include "apps/option_validators.h"
#include "core/format.h"
#include "core/sample_sequence.h"
#include "fem/closure.h"
#include "montecarlo/film/reconstruction_filter.h"
#include "montecarlo/render.h"

namespace interflect::apps {
namespace {

/// Where the options of how much a form-factor method does go.
struct EffortOptions {
  const std::string& method;
  std::uint64_t& samples;
  int& resolution;
  int& visibility_rays;
  double& visibility_error;
};

void add_effort(CLI::App& command, const EffortOptions& options) {
  command
      .add_option("--samples", options.samples,
                  "Of Monte Carlo methods: a pair, a row, or in all; 0: as the tolerance asks")
      ->transform(count(1e15))
      ->capture_default_str();
  command.add_option("--resolution", options.resolution, "Cells across a hemicube or a plane")
      ->check(whole(2, 8192))
      ->capture_default_str();
  command
      .add_option("--visibility-rays", options.visibility_rays,
                  "Of gauss-lambert and duffy: for a pair that something may hide")
      ->check(whole(4, 65536))
      ->capture_default_str();
  command
      .add_option("--visibility-error", options.visibility_error,
                  "Of the same: more rays, until the standard error of the part of a pair that is seen is below")
      ->transform(fraction(1e-3, 0.5))
      ->default_str("none: as many rays as were asked for");
  refuse_what_is_not_heeded(command, options.method);
}

CLI::Option* add_row_tolerance(CLI::App& command, double& tolerance) {
  return command.add_option("--tolerance", tolerance, "Largest sum of a row's errors, max_i sum_j |dF_ij|")
      ->check(within(1e-9, 0.5))
      ->capture_default_str();
}

/// The polynomials' degree; by analytic form factors, where no others are asked for.
/// @param method  that of form factors
CLI::Option* add_order(CLI::App& command, fem::RadiositySettings& s, const CLI::Option* method) {
  return command
      .add_option_function<int>(
          "--order",
          [&s, method](int order) {
            s.order = order;
            if (order > 0 && method->empty()) s.form_factors = "analytic";
          },
          "Degree of the polynomials on an element; from 1 on by analytic, gauss-lambert or duffy, or\n"
          "without a matrix by stochastic-jacobi or regular-stochastic-jacobi")
      ->check(whole(0, 3));
}

/// What elements are made for: by polynomials, where no order is asked for.
void add_goal(CLI::App& command, SolveOptions& options, const CLI::Option* method, const CLI::Option* order_given) {
  fem::RadiositySettings& s = options.settings;
  const auto polynomials = [&s, method, order_given](int order) {
    if (order_given->empty()) s.order = std::max(s.order, order);
    if (method->empty()) s.form_factors = "analytic";
  };
  command
      .add_option_function<double>(
          "--target-error",
          [&options, polynomials](double target) {
            options.target_error = target;
            polynomials(2);
          },
          "Make elements for a goal, pass after pass, until its error is estimated below this part of it, such as 1%")
      ->transform(fraction());
  command
      .add_option_function<std::string>(
          "--goal",
          [&options, polynomials](const std::string& goal) {
            options.goal = goal;
            polynomials(1);
          },
          "Whose error counts: a sensor, a surface, or camera:NAME; default: all sensors")
      ->check(named("a sensor, a surface or a camera"));
}

/// Whose functions are linear unless --order says otherwise, and constants at centroids; by analytic form factors.
void add_projection(CLI::App& command, fem::RadiositySettings& s, const CLI::Option* method, const CLI::Option* order) {
  command
      .add_option_function<std::string>(
          "--projection",
          [&s, method, order](const std::string& name) {
            s.projection = fem::projection_named(name);
            if (s.projection == fem::Projection::galerkin) return;
            if (order->empty() && s.projection != fem::Projection::centroids) s.order = 1;
            if (method->empty()) s.form_factors = "analytic";  // without noise, as what is found at nodes
          },
          "How the equation is made finite: in the mean (galerkin, continuous), or at nodes (gauss-points, vertices, "
          "centroids)")
      ->check(CLI::IsMember(fem::projection_names()))
      ->default_str("galerkin");
}

void add_max_memory(CLI::App& command, double& bytes) {
  command.add_option("--max-memory", bytes, "Refuse what needs more, such as 4GB")
      ->transform(memory())
      ->default_str(core::format_bytes(bytes));
}

void add_drop_below(CLI::App& command, double& drop_below) {
  command
      .add_option("--drop-below", drop_below,
                  "Save memory: leave out pairs with F_ij and F_ji below it, and count them as error")
      ->check(within(0.0, 1.0))
      ->capture_default_str();
}

void add_overshoot(CLI::App& command, double& overshoot) {
  command.add_option("--overshoot", overshoot, "Of progressive: the share of the ambient light that is shot ahead")
      ->check(within(0.0, 1.0))
      ->capture_default_str();
}

/// When solvers stop, and what some may be told.
void add_solver_settings(CLI::App& command, fem::RadiositySettings& s) {
  command.add_option("--solver-tolerance", s.stopping.tolerance, "Relative residual at which it stops")
      ->check(within(1e-15, 0.1))
      ->capture_default_str();
  command
      .add_option("--steps", s.stopping.max_iterations,
                  "Iterations, or rounds of samples, after which it stops in any case: as many as the record of a run "
                  "says that was stopped give its result again")
      ->check(whole(1, 1 << 30))
      ->capture_default_str();
  command
      .add_option("--unshot", s.stopping.unshot,
                  "Unshot light, over all that is emitted, at which southwell and progressive stop")
      ->transform(fraction(0.0, 1.0))
      ->capture_default_str();
  command.add_option("--relaxation", s.solver_settings.relaxation, "Of over-relaxation: what of a step is gone")
      ->check(within(1e-3, 1.999))
      ->capture_default_str();
  add_overshoot(command, s.solver_settings.overshoot);
  command
      .add_option("--noise", s.stopping.noise,
                  "Relative standard error, L2 of what is reflected, at which those stop that sample")
      ->transform(fraction(1e-6, 0.5))
      ->default_str("1%");
  command.add_option("--sequence", s.solver_settings.sequence, "Of numbers that those sample by")
      ->check(CLI::IsMember(core::sequence_names()))
      ->capture_default_str();
}

/// Those whose answer is all of the solution.
std::vector<std::string> solvers_of_all() {
  using Needs = solvers::SolverEntry::Needs;
  return solvers::solver_names(
      {Needs::products, Needs::symmetry, Needs::walks, Needs::lines, Needs::points, Needs::closed_room});
}

void add_solver(CLI::App& command, fem::RadiositySettings& s) {
  command
      .add_option("--solver", s.solver,
                  "Linear solver; interflect solvers tells of each, and which ones sample, without a matrix")
      ->check(CLI::IsMember(solvers_of_all()))
      ->capture_default_str();
  add_solver_settings(command, s);
}

}  // namespace

void add_common(CLI::App& app, CommonOptions& common) {
  app.add_option("--seed", common.seed, "Same scene, settings and seed: same numbers, bit by bit")
      ->check(whole(0, std::numeric_limits<std::uint64_t>::max()))
      ->capture_default_str();
  app.add_option("--threads", common.threads, "Threads to use (0: all); results do not depend on it")
      ->check(whole(0, 1024))
      ->capture_default_str();
  app.add_option("--max-time", common.max_time, "Stop after 90s, 15min or 2h as by Ctrl-C: what there is is kept")
      ->transform(duration());
  app.add_flag("--json", common.json, "Print the result as one JSON object");
  app.add_flag("-q,--quiet", common.quiet, "No progress, and no messages but errors and shortfalls");
  app.add_flag("-v,--verbose", common.verbose, "Say more");
}

void add_scene(CLI::App& command, std::filesystem::path& scene) {
  command.add_option("SCENE", scene, "Scene file (docs/scene.md)")->check(named("a scene file"))->required();
}

void add_camera(CLI::App& command, std::string& camera) {
  command.add_option("--camera", camera, "Camera of the scene; default: its first")->check(named("a camera"));
}

CLI::Option* add_folder(CLI::App& command, std::filesystem::path& out, const std::string& what) {
  return command.add_option("-o,--out", out, "Folder for " + what)->check(named("a folder"))->required();
}

void add_no_pictures(CLI::App& command, bool& pictures, const std::string& description) {
  command.add_flag_callback(
      "--no-pictures", [&pictures] { pictures = false; }, description);
}

void add_forecast(CLI::App& command, bool& forecast_only, CLI::Option* out) {
  out->option_text("TEXT REQUIRED without --forecast");
  command.add_flag_callback(
      "--forecast",
      [&forecast_only, out] {
        forecast_only = true;
        out->required(false);
      },
      "Say what it would need, and stop: no --out is needed");
}

void add_element_size(CLI::App& command, double& size, const std::string& when_none) {
  command.add_option("--element-size", size, "Longest edge of an element [m]; default: " + when_none)->check(length());
}

CLI::Option* add_form_factors(CLI::App& command, std::string& method) {
  return command.add_option("--form-factors", method, "Form-factor method")
      ->check(CLI::IsMember(fem::form_factor_names()))
      ->capture_default_str();
}

void add_quadrature_tolerance(CLI::App& command, double& tolerance, const std::string& of) {
  command.add_option("--quadrature-tolerance", tolerance, "Relative error of " + of)
      ->check(within(1e-14, 0.5))
      ->capture_default_str();
}

void add_closure(CLI::App& command, std::string& closure) {
  std::vector<std::string> names = fem::closure_names();
  names.emplace_back("none");
  CLI::Option* named =
      command
          .add_option("--closure", closure,
                      "Change the form factors least so that rows, with an open scene's environment, add up to 1")
          ->check(CLI::IsMember(names))
          ->capture_default_str();
  command
      .add_flag_callback(
          "--restore-closure", [&closure] { closure = "scaling"; }, "The same as --closure scaling")
      ->excludes(named);
}

void add_intersector(CLI::App& command, std::string& intersector, const std::string& description) {
  command.add_option("--intersector", intersector, description)
      ->check(CLI::IsMember(raycast::ray_caster_names()))
      ->capture_default_str();
}

void add_target(CLI::App& command, double& target) {
  command.add_option("--target", target, "Relative standard error of every measurement, such as 1%")
      ->transform(fraction())
      ->default_str("1%");
}

void add_paths(CLI::App& command, std::string& paths) {
  command
      .add_option(
          "--paths", paths,
          "Paths of light that count, from light to eye: L any light (A with an area, P point, F far, B parallel), D "
          "diffuse, G glossy, S mirror or glass, . any of these; ( ) | * + ? as ever")
      ->check(given("a class of paths, such as L.*E,"))
      ->capture_default_str();
}

void add_sampling(CLI::App& command, TraceOptions& options) {
  command.add_option("--spp", options.samples, "Samples per pixel at most; of whitted a multiple of 16")
      ->check(whole(1, 1 << 24))
      ->capture_default_str();
  command.add_option("--filter", options.filter, "How points of the film count for pixels near them")
      ->check(CLI::IsMember(montecarlo::filter_names()))
      ->capture_default_str();
  command
      .add_option(
          "--sequence", options.sequence,
          core::format("Numbers that paths begin with, of --integrator path; but for independent ones --spp is a "
                       "multiple of %d",
                       montecarlo::sequence_batches))
      ->check(CLI::IsMember(core::sequence_names()))
      ->capture_default_str();
  command
      .add_option("--target", options.target,
                  "End the picture where relative standard errors of the pixels that have found light, in the root "
                  "mean square, "
                  "are below, such as 5%; exit with 1 if all --spp do not do it")
      ->transform(fraction());
}

void add_checkpoint(CLI::App& command, TraceOptions& options) {
  command.add_flag("--resume", options.resume,
                   "Go on from the checkpoint NAME.checkpoint.h5 that an earlier run left beside its picture: every "
                   "minute, and when "
                   "it was stopped; it is removed when the picture has the samples, or meets the --target, asked for");
  command.add_flag("--keep-checkpoint", options.keep_checkpoint,
                   "Leave the checkpoint of a finished picture too: with --resume and a larger --spp it grows further");
}

void add_accuracy(CLI::App& command, double& accuracy, const std::string& of) {
  command.add_option("--accuracy", accuracy, "Relative standard error of " + of + ", such as 1%")
      ->transform(fraction())
      ->default_str("1%");
}

void add_effort(CLI::App& command, fem::RadiositySettings& s) {
  add_row_tolerance(command, s.row_tolerance)->default_str("none: --quadrature-tolerance");
  add_effort(command, EffortOptions{s.form_factors, s.samples, s.resolution, s.visibility_rays, s.visibility_error});
}

void add_effort(CLI::App& command, ViewFactorOptions& o) {
  add_row_tolerance(command, o.tolerance);
  add_effort(command, EffortOptions{o.form_factors, o.samples, o.resolution, o.visibility_rays, o.visibility_error});
}

void add_radiosity(CLI::App& command, SolveOptions& options, CLI::Option* out) {
  fem::RadiositySettings& s = options.settings;
  add_element_size(command, s.element_size, "for about 2 500 elements, more where small surfaces each need some");
  add_max_memory(command, s.max_memory);
  CLI::Option* method = add_form_factors(command, s.form_factors);
  method->default_str(core::format("%s; beside mirrors hemisphere-rays", fem::default_form_factors));
  method->each([&s](const std::string&) { s.form_factors_chosen = true; });
  CLI::Option* order = add_order(command, s, method);
  order->default_str("0; 1 with --goal or a linear --projection, 2 with --target-error");
  add_goal(command, options, method, order);
  add_projection(command, s, method, order);
  command
      .add_option("--factors", options.factors,
                  "View factors of an earlier view-factors --element-size run: only lights and reflectances may differ")
      ->check(named("a file"));
  add_quadrature_tolerance(command, s.quadrature_tolerance, "an unoccluded form factor");
  add_solver(command, s);
  add_intersector(command, s.intersector, "Ray caster; brute is slow, double precision, for checking");
  add_closure(command, s.closure);
  add_drop_below(command, s.drop_below);
  add_effort(command, s);
  add_forecast(command, options.forecast_only, out);
}

void add_shooting(CLI::App& command, fem::RadiositySettings& s) {
  add_element_size(command, s.element_size, "that of solve");
  add_max_memory(command, s.max_memory);
  add_form_factors(command, s.form_factors);
  add_quadrature_tolerance(command, s.quadrature_tolerance, "an unoccluded form factor");
  add_effort(command, EffortOptions{s.form_factors, s.samples, s.resolution, s.visibility_rays, s.visibility_error});
  command.add_option("--solver", s.solver, "The brightest shoots what it has, or what makes its residual 0")
      ->check(CLI::IsMember({"progressive", "southwell"}))
      ->capture_default_str();
  add_overshoot(command, s.solver_settings.overshoot);
  command.add_option("--unshot", s.stopping.unshot, "Unshot light, over all that is emitted, at which it stops")
      ->transform(fraction())
      ->default_str("1%");
  add_intersector(command, s.intersector, "Ray caster; brute is slow, double precision, for checking");
}

void add_equations(CLI::App& command, fem::RadiositySettings& s) {
  add_element_size(command, s.element_size, "that of solve");
  add_max_memory(command, s.max_memory);
  const CLI::Option* method = add_form_factors(command, s.form_factors);
  add_projection(command, s, method, add_order(command, s, method)->default_str("0; 1 with a linear --projection"));
  add_quadrature_tolerance(command, s.quadrature_tolerance, "an unoccluded form factor");
  add_drop_below(command, s.drop_below);
  add_solver_settings(command, s);
  refuse_what_is_not_heeded(command, s.form_factors);
}

}  // namespace interflect::apps

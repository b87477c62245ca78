#include "apps/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <optional>

#include "apps/option_texts.h"
#include "core/build_info.h"
#include "core/error.h"
#include "core/format.h"
#include "fem/closure.h"

namespace interflect::apps {
namespace {

constexpr const char* example_scene = "data/scenes/cornell_box.json";

CLI::Validator within(double low, double high) {
  return {[=](std::string& text) { return outside(text, low, high); }, core::format("in [%g, %g]", low, high)};
}
CLI::Validator count(double most) {
  return {[=](std::string& text) { return to_count(text, most); }, core::format("up to %g", most)};
}
CLI::Validator memory() { return {to_bytes, "SIZE"}; }
CLI::Validator length() { return {no_length, "METRES"}; }
CLI::Validator fraction() { return {to_fraction, "PART"}; }
CLI::Validator seed() { return {no_seed, "NUMBER"}; }

void add_common(CLI::App& app, CommonOptions& common) {
  app.add_option("--seed", common.seed, "Same scene, settings and seed: same numbers, bit by bit")
      ->check(seed())
      ->capture_default_str();
  app.add_option("--threads", common.threads, "Threads to use (0: all); results do not depend on it")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  app.add_flag("--json", common.json, "Print the result as one JSON object");
  app.add_flag("-q,--quiet", common.quiet, "No progress, and no messages but errors and shortfalls");
  app.add_flag("-v,--verbose", common.verbose, "Say more");
}

void add_scene(CLI::App& command, std::filesystem::path& scene) {
  command.add_option("SCENE", scene, "Scene file (docs/scene.md)")->required();
}

constexpr const char* when_no_rows = "none: --quadrature-tolerance";

/// Settings that change nothing are mistakes: of the method, or of what one expects of it.
void require_heeded(const CLI::Option& option, const std::string& method, fem::Setting setting) {
  if (!option.empty() && fem::setting_of(method) != setting)
    throw CLI::ValidationError(option.get_name(), "form factors by " + method + " have none: --form-factors NAME");
}

/// Where the options of how much a form-factor method does go.
struct EffortOptions {
  const std::string& method;
  double& row_tolerance;
  std::uint64_t& samples;
  int& resolution;
  int& visibility_rays;
};

/// @param when_0  what a tolerance of 0 means, where that is the default
void add_effort(CLI::App& command, const EffortOptions& options, const std::string& when_0 = "") {
  CLI::Option* tolerance =
      command.add_option("--tolerance", options.row_tolerance, "Largest sum of a row's errors, max_i sum_j |dF_ij|")
          ->check(within(1e-9, 0.5))
          ->capture_default_str();
  if (!when_0.empty()) tolerance->default_str(when_0);
  const CLI::Option* samples =
      command
          .add_option("--samples", options.samples,
                      "Of Monte Carlo methods: a pair, a row, or in all; 0: as the tolerance asks")
          ->transform(count(1e15))
          ->capture_default_str();
  const CLI::Option* cells =
      command.add_option("--resolution", options.resolution, "Cells across a hemicube or a plane")
          ->check(CLI::Range(2, 8192))
          ->capture_default_str();
  const CLI::Option* rays = command
                                .add_option("--visibility-rays", options.visibility_rays,
                                            "Of gauss-lambert and hybrid: for a pair that something may hide")
                                ->check(CLI::Range(4, 65536))
                                ->capture_default_str();
  command.parse_complete_callback([samples, cells, rays, &method = options.method] {
    require_heeded(*samples, method, fem::Setting::samples);
    require_heeded(*cells, method, fem::Setting::resolution);
    require_heeded(*rays, method, fem::Setting::rays);
  });
}

EffortOptions effort_of(fem::RadiositySettings& s) {
  return {s.form_factors, s.row_tolerance, s.samples, s.resolution, s.visibility_rays};
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

void add_no_pictures(CLI::App& command, bool& pictures) {
  command.add_flag_callback(
      "--no-pictures", [&pictures] { pictures = false; }, "Write no PNG");
}

/// @param out  where the results go
void add_radiosity(CLI::App& command, SolveOptions& options, CLI::Option* out) {
  fem::RadiositySettings& s = options.settings;
  command
      .add_option(
          "--element-size", s.element_size,
          "Longest edge of an element [m]; default: for about 2 500 elements, more where small surfaces each need some")
      ->check(length());
  command.add_option("--max-memory", s.max_memory, "Refuse what needs more, such as 4GB")
      ->transform(memory())
      ->default_str(core::format_bytes(s.max_memory));
  CLI::Option* method = command.add_option("--form-factors", s.form_factors, "Form-factor method")
                            ->check(CLI::IsMember(fem::form_factor_names()))
                            ->capture_default_str();
  CLI::Option* order_given = command
                                 .add_option_function<int>(
                                     "--order",
                                     [&s, method](int order) {
                                       s.order = order;
                                       if (order > 0 && method->empty()) s.form_factors = "analytic";
                                     },
                                     "Degree of the polynomials on an element; from 1 on with form factors by analytic")
                                 ->check(CLI::Range(0, 3))
                                 ->default_str("0");
  const auto polynomials = [&s, method, order_given] {
    if (order_given->empty()) s.order = 1;
    if (method->empty()) s.form_factors = "analytic";
  };
  command
      .add_option_function<double>(
          "--target-error",
          [&options, polynomials](double target) {
            options.target_error = target;
            polynomials();
          },
          "Make elements for a goal, pass after pass, until its error is estimated below this part of it, such as 1%")
      ->transform(fraction());
  command.add_option_function<std::string>(
      "--goal",
      [&options, polynomials](const std::string& goal) {
        options.goal = goal;
        polynomials();
      },
      "Whose error counts: a sensor, a surface, or camera:NAME; default: all sensors");
  command.add_option(
      "--factors", options.factors,
      "View factors of an earlier view-factors --element-size run: only lights and reflectances may differ");
  command.add_option("--quadrature-tolerance", s.quadrature_tolerance, "Relative error of an unoccluded form factor")
      ->check(within(1e-14, 0.5))
      ->capture_default_str();
  command.add_option("--solver", s.solver, "Linear solver")
      ->check(CLI::IsMember(solvers::solver_names()))
      ->capture_default_str();
  command.add_option("--solver-tolerance", s.stopping.tolerance, "Relative residual at which it stops")
      ->check(within(1e-15, 0.1))
      ->capture_default_str();
  command.add_option("--intersector", s.intersector, "Ray caster; brute is slow, double precision, for checking")
      ->check(CLI::IsMember(raycast::ray_caster_names()))
      ->capture_default_str();
  add_closure(command, s.closure);
  command
      .add_option("--drop-below", s.drop_below,
                  "Save memory: leave out pairs with F_ij and F_ji below it, and count them as error")
      ->check(within(0.0, 1.0))
      ->capture_default_str();
  add_effort(command, effort_of(s), when_no_rows);
  command.add_flag_callback(
      "--forecast",
      [&options, out] {
        options.forecast_only = true;
        out->required(false);
      },
      "Say what it would need, and stop: no --out is needed");
}

CLI::Option* add_folder(CLI::App& command, std::filesystem::path& out) {
  return command.add_option("-o,--out", out, "Folder for the results")->required();
}

/// A subcommand with an example; `run` is called with the options that parsing filled.
template <class Options>
CLI::App* add_command(CLI::App& app, const char* name, const char* description, const std::string& example,
                      ExitStatus (*run)(const Options&, const CommonOptions&, Run&), std::shared_ptr<Options> options,
                      Command& chosen) {
  CLI::App* command = app.add_subcommand(name, description);
  command->footer("Example:\n  " + example);
  command->callback([&chosen, run, options] {
    chosen.execute = [run, options](const CommonOptions& common, Run& r) { return run(*options, common, r); };
  });
  return command;
}

void add_solve(CLI::App& app, Command& chosen) {
  auto options = std::make_shared<SolveOptions>();
  CLI::App* command = add_command<SolveOptions>(
      app, "solve", "Radiosity of a scene: tables, fields for ParaView, pictures",
      core::format("interflect solve %s -o out/cornell --element-size 0.03", example_scene), solve, options, chosen);
  add_scene(*command, options->scene);
  add_radiosity(*command, *options, add_folder(*command, options->out));
  add_no_pictures(*command, options->pictures);
  command->add_flag("--bounds", options->bounds,
                    "Prove bounds of every number too, element by element and at sensors (docs/bounds.md)");
}

void add_validate(CLI::App& app, Command& chosen) {
  auto options = std::make_shared<ValidateOptions>();
  CLI::App* command = add_command<ValidateOptions>(
      app, "validate", "Solve, trace the same measurements by Monte Carlo, and certify how well they agree",
      core::format("interflect validate %s -o out/cornell --accuracy 0.5%%", example_scene), validate, options, chosen);
  add_scene(*command, options->solve.scene);
  add_radiosity(*command, options->solve, add_folder(*command, options->solve.out));
  add_no_pictures(*command, options->solve.pictures);
  command->add_option("--accuracy", options->accuracy, "Relative standard error of each traced value, such as 1%")
      ->transform(fraction())
      ->default_str("1%");
  command->add_option("--elements", options->elements, "Elements to judge, a stratified choice")
      ->check(CLI::Range(1, 100000000))
      ->capture_default_str();
  command->add_flag("--all", options->all_elements, "Judge every element");
  command->add_option("--picture-spp", options->picture_samples, "Samples per pixel of the traced picture")
      ->check(CLI::Range(1, 1 << 20))
      ->capture_default_str();
}

void add_render(CLI::App& app, Command& chosen) {
  auto options = std::make_shared<RenderOptions>();
  CLI::App* command = add_command<RenderOptions>(
      app, "render", "A picture by radiosity, with an error for each pixel",
      core::format("interflect render %s --order 1 --element-size 0.3 --gather -o cornell.exr", example_scene), render,
      options, chosen);
  add_scene(*command, options->solve.scene);
  add_radiosity(
      *command, options->solve,
      command
          ->add_option("-o,--out", options->image,
                       "Picture to write: .exr (radiance, with errors) or .png; the other is written beside it")
          ->required());
  command->add_option("--camera", options->camera, "Camera of the scene; default: its first");
  command->add_flag("--gather", options->gather,
                    "Pixels are the iterated solution, E + rho T B_h: shadows as they are, not as elements have them");
  command->add_option("--rays", options->rays, "A pixel, rounded to a square")
      ->check(CLI::Range(1, 4096))
      ->capture_default_str();
}

void add_trace(CLI::App& app, Command& chosen) {
  auto options = std::make_shared<TraceOptions>();
  CLI::App* command = add_command<TraceOptions>(
      app, "trace", "A picture by path tracing",
      core::format("interflect trace %s --camera front --spp 256 -o cornell.exr", example_scene), trace, options,
      chosen);
  add_scene(*command, options->scene);
  command->add_option("--camera", options->camera, "Camera of the scene; default: its first");
  command->add_option("--spp", options->samples, "Samples per pixel")
      ->check(CLI::Range(1, 1 << 24))
      ->capture_default_str();
  command
      ->add_option("-o,--out", options->image,
                   "Picture to write: .exr (radiance, with standard errors) or .png; the other is "
                   "written beside it")
      ->required();
  command->add_option("--estimates", options->estimates, "Folder for traced surfaces.csv and sensors.csv");
  command->add_option("--accuracy", options->accuracy, "Relative standard error of those estimates, such as 1%")
      ->transform(fraction())
      ->default_str("1%");
  command->add_option("--intersector", options->intersector, "Ray caster")
      ->check(CLI::IsMember(raycast::ray_caster_names()))
      ->capture_default_str();
}

void add_view_factors(CLI::App& app, Command& chosen) {
  auto options = std::make_shared<ViewFactorOptions>();
  CLI::App* command = add_command<ViewFactorOptions>(
      app, "view-factors", "View factors of a mesh or scene, with an error on each",
      core::format("interflect view-factors %s -o F.h5 --element-size 0.1", example_scene), view_factors, options,
      chosen);
  command->add_option("FILE", options->input, "OBJ, PLY, STL, glTF, VTU, VTP, View3D's .vs3, or a scene (.json)")
      ->required();
  CLI::Option* out = command
                         ->add_option("-o,--out", options->out,
                                      "F.h5, F.npz, F.mtx or F.csv; the others are made from an .h5 beside them")
                         ->required();
  command->add_flag_callback(
      "--forecast",
      [forecast = &options->forecast_only, out] {
        *forecast = true;
        out->required(false);
      },
      "Say what it would need, and stop: no --out is needed");
  add_effort(*command, {options->form_factors, options->tolerance, options->samples, options->resolution,
                        options->visibility_rays});
  command->add_option("--form-factors", options->form_factors, "Form-factor method")
      ->check(CLI::IsMember(fem::form_factor_names()))
      ->capture_default_str();
  add_closure(*command, options->closure);
  command
      ->add_option("--element-size", options->element_size,
                   "Longest edge of an element [m]; default: one element a face")
      ->check(length());
  command->add_option("--units", options->geometry.unit, "Of the file's coordinates: m, cm, mm, ft, in");
  command->add_flag("--two-sided", options->geometry.two_sided, "Backs of faces have view factors too: thin plates");
  command->add_flag("--whole-groups", options->geometry.whole_groups,
                    "One surface for each group and material of a mesh, not for each face");
  command->add_option("--only-occlude", options->geometry.only_occlude,
                      "Surfaces or groups that hide, and have no view factors");
  command->add_option("--leave-out", options->geometry.left_out, "Surfaces or groups that neither see nor hide");
  command
      ->add_option("--view-of", options->view_of,
                   "Also F.view.vtu and F.view.png: of every element the view factor to this surface or group")
      ->check([](const std::string& name) {
        return std::string(name.empty() ? "the name of a surface or group is expected" : "");
      });
  command->add_option("--groups", options->groups, "Sum the factors of a .csv by this")
      ->check(CLI::IsMember({"surface", "group", "material"}));
}

void add_compare_form_factors(CLI::App& app, Command& chosen) {
  auto options = std::make_shared<CompareFormFactorsOptions>();
  CLI::App* command = add_command<CompareFormFactorsOptions>(
      app, "compare-form-factors", "Every form-factor method on one scene: error against the exact one, time, energy",
      core::format("interflect compare-form-factors %s --element-size 0.15 -o out/methods", example_scene),
      compare_form_factors, options, chosen);
  add_scene(*command, options->scene);
  command->add_option("-o,--out", options->out, "Folder for the table and the plot")->required();
  command->add_option("--element-size", options->element_size, "Longest edge of an element [m]; default: that of solve")
      ->check(length());
  command->add_option("--tolerance", options->tolerance, "Largest sum of a row's errors in the reference")
      ->check(within(1e-9, 0.5))
      ->capture_default_str();
}

void add_exchange(CLI::App& app, Command& chosen) {
  auto options = std::make_shared<ExchangeOptions>();
  options->settings.form_factors = "analytic";
  CLI::App* command = add_command<ExchangeOptions>(
      app, "exchange", "Net radiative exchange of grey surfaces with temperatures or heat fluxes",
      "interflect exchange data/scenes/oven.json -o out/oven --environment 293.15", exchange, options, chosen);
  add_scene(*command, options->scene);
  command->add_option("-o,--out", options->out, "Folder for the results")->required();
  command->add_option("--environment", options->environment, "Temperature of what openings look at [K]")
      ->check(within(0.0, 1e5))
      ->capture_default_str();
  command
      ->add_option("--element-size", options->settings.element_size,
                   "Longest edge of an element [m]; default: that of solve")
      ->check(length());
  command->add_option("--form-factors", options->settings.form_factors, "Form-factor method")
      ->check(CLI::IsMember(fem::form_factor_names()))
      ->capture_default_str();
  command
      ->add_option("--quadrature-tolerance", options->settings.quadrature_tolerance, "Relative error of a form factor")
      ->check(within(1e-14, 0.5))
      ->capture_default_str();
  add_no_pictures(*command, options->pictures);
  add_closure(*command, options->settings.closure);
  add_effort(*command, effort_of(options->settings), when_no_rows);
}

void add_info(CLI::App& app, Command& chosen) {
  auto options = std::make_shared<InfoOptions>();
  add_scene(*add_command<InfoOptions>(app, "info", "What was read: surfaces, materials, flux, box in metres, repairs",
                                      core::format("interflect info %s", example_scene), info, options, chosen),
            options->scene);
}

void add_check(CLI::App& app, Command& chosen) {
  auto options = std::make_shared<CheckOptions>();
  add_scene(*add_command<CheckOptions>(app, "check", "Looks for gaps, flipped normals, duplicate and coplanar faces",
                                       core::format("interflect check %s", example_scene), check, options, chosen),
            options->scene);
}

std::string version_text() {
  const core::BuildInfo build = core::build_info();
  return core::format("interflect %s (%s, up to %d channels)\nGPL-3.0-or-later, without any warranty",
                      build.version.c_str(), build.compiler.c_str(), build.spectrum_capacity);
}

/// What is wrong, in the words of who typed it: the parser's own name neither a mistyped command nor, first, a mistyped
/// option.
std::string complaint(const CLI::App& app, const CLI::ParseError& error) {
  const auto given = app.get_subcommands();
  const std::string command = given.empty() ? "interflect" : "interflect " + given.front()->get_name();
  const std::vector<std::string> left = app.remaining(true);
  const auto is_option = [](const std::string& word) { return word.rfind('-', 0) == 0; };
  const auto option = std::find_if(left.begin(), left.end(), is_option),
             word = std::find_if_not(left.begin(), left.end(), is_option);
  std::string what = error.what();
  if (given.empty()) {
    std::string names;
    for (const CLI::App* sub : app.get_subcommands({})) names += (names.empty() ? "" : ", ") + sub->get_name();
    what = (word != left.end() ? "'" + *word + "' is no command" : "a command is missing") + "; there are " + names;
  } else if (option != left.end()) {
    what = *option + " is no option of " + command;
  }
  return what + "; " + command + " --help tells more";
}

}  // namespace

std::optional<Command> parse_command_line(int argc, char** argv) {
  CLI::App app("How light is exchanged between surfaces, by finite elements, checked by Monte Carlo.", "interflect");
  Command command;
  app.set_version_flag("--version", version_text());
  app.require_subcommand(1);
  app.fallthrough();
  app.footer(
      core::format("Start with:\n  interflect validate %s -o out/cornell\n"
                   "Exit status: 0 done, 1 done but not as hoped (not validated, findings), 2 bad input.\n"
                   "Each command has its own --help with an example.",
                   example_scene));
  add_common(app, command.common);
  add_solve(app, command);
  add_validate(app, command);
  add_render(app, command);
  add_trace(app, command);
  add_view_factors(app, command);
  add_compare_form_factors(app, command);
  add_exchange(app, command);
  add_info(app, command);
  add_check(app, command);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& asked) {  // --help, --version
    app.exit(asked);
    return std::nullopt;
  } catch (const CLI::ParseError& error) {
    throw core::InputError("command line", complaint(app, error));
  }
  for (int i = 0; i < argc; ++i) command.common.command_line += (i > 0 ? " " : "") + std::string(argv[i]);
  return command;
}

}  // namespace interflect::apps

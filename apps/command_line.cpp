#include "apps/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <limits>
#include <memory>
#include <optional>

#include "apps/option_groups.h"
#include "apps/option_validators.h"
#include "core/build_info.h"
#include "core/error.h"
#include "core/format.h"
#include "montecarlo/integrators.h"

namespace interflect::apps {
namespace {

constexpr const char* example_scene = "data/scenes/cornell_box.json";

/// Those that stand before the command or after it, as they are told of before it.
std::string options_of_every_command(const CLI::App& app) {
  std::vector<const CLI::Option*> of_all;
  for (const CLI::Option* option : app.get_options())
    if (option != app.get_help_ptr() && option->get_name() != "--version") of_all.push_back(option);
  const std::string text = CLI::Formatter().make_group("Options of every command", false, of_all);
  return text.substr(text.find_first_not_of('\n'));
}

/// A subcommand with an example; `run` is called with the options that parsing filled.
template <class Options>
CLI::App* add_command(CLI::App& app, const char* name, const char* description, const std::string& example,
                      ExitStatus (*run)(const Options&, const CommonOptions&, Run&), std::shared_ptr<Options> options,
                      Command& chosen) {
  CLI::App* command = app.add_subcommand(name, description);
  command->footer(options_of_every_command(app) + "\nExample:\n  " + example);
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
  command->add_flag("--light-groups", options->settings.light_groups,
                    "Keep what each group of lights does alone, for interflect dim");
  command->add_flag("--bounds", options->bounds,
                    "Prove bounds of every number too, element by element and at sensors (docs/bounds.md)");
  command->add_flag("--residual", options->residual,
                    "Find E + rho T B - B too, at points of each element and along its edges, and what it bounds");
}

void add_validate(CLI::App& app, Command& chosen) {
  auto options = std::make_shared<ValidateOptions>();
  CLI::App* command = add_command<ValidateOptions>(
      app, "validate", "Solve, trace the same measurements by Monte Carlo, and certify how well they agree",
      core::format("interflect validate %s -o out/cornell --accuracy 0.5%%", example_scene), validate, options, chosen);
  add_scene(*command, options->solve.scene);
  add_radiosity(*command, options->solve, add_folder(*command, options->solve.out));
  add_no_pictures(*command, options->solve.pictures);
  add_accuracy(*command, options->accuracy, "each traced value");
  command
      ->add_option("--integrator", options->integrator,
                   "How values are traced: one that is unbiased and finds all that radiosity does")
      ->check(CLI::IsMember(montecarlo::integrator_names()))
      ->capture_default_str();
  command->add_option("--elements", options->elements, "Elements to judge, a stratified choice")
      ->check(whole(1, 100000000))
      ->capture_default_str();
  command->add_flag("--all", options->all_elements, "Judge every element");
  command->add_option("--picture-spp", options->picture_samples, "Samples per pixel of the traced picture")
      ->check(whole(1, 1 << 20))
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
  add_camera(*command, options->camera);
  command->add_flag("--gather", options->gather,
                    "Pixels are the iterated solution, E + rho T B_h: shadows as they are, not as elements have them");
  command->add_option("--rays", options->rays, "A pixel, rounded to a square")
      ->check(whole(1, 4096))
      ->default_str(core::format("%d; beside mirrors and glass %d, with --gather %d", rays_a_pixel, rays_by_mirrors,
                                 rays_by_mirrors_gathered));
}

void add_trace(CLI::App& app, Command& chosen) {
  auto options = std::make_shared<TraceOptions>();
  CLI::App* command = add_command<TraceOptions>(
      app, "trace", "A picture by Monte Carlo, and what reaches surfaces and sensors",
      core::format("interflect trace %s --camera front --spp 256 -o cornell.exr", example_scene), trace, options,
      chosen);
  add_scene(*command, options->scene);
  add_camera(*command, options->camera);
  command
      ->add_option("-o,--out", options->image,
                   "Picture to write: .exr (radiance, with standard errors) or .png; the other is "
                   "written beside it")
      ->required();
  command->add_option("--integrator", options->integrator, "How picture and estimates are traced (docs/compare.md)")
      ->check(CLI::IsMember(montecarlo::integrator_names()))
      ->capture_default_str();
  add_sampling(*command, *options);
  add_checkpoint(*command, *options);
  command->add_option("--estimates", options->estimates, "Folder for traced surfaces.csv and sensors.csv")
      ->check(named("a folder"));
  add_accuracy(*command, options->accuracy, "those estimates");
  add_paths(*command, options->paths);
  command
      ->add_option("--group", options->group,
                   "Lights that shine alone: a light group of surfaces, a light of that name, or sky; default: all")
      ->check(named("a light group"));
  add_intersector(*command, options->intersector, "Ray caster");
}

void add_compare(CLI::App& app, Command& chosen) {
  auto options = std::make_shared<CompareOptions>();
  CLI::App* command = add_command<CompareOptions>(
      app, "compare",
      "Several integrators on one scene: do they agree on the paths that each two find, and which is best",
      core::format("interflect compare %s --integrators path,light,bidirectional --target 1%% -o out/compared",
                   example_scene),
      compare, options, chosen);
  add_scene(*command, options->scene);
  add_folder(*command, options->out);
  command
      ->add_option("--integrators", options->integrators,
                   "Which ones; default: all but unidirectional, which finds lights by chance, and two-pass and "
                   "controlled, which solve first")
      ->delimiter(',')
      ->check(CLI::IsMember(montecarlo::integrator_names()));
  add_target(*command, options->target);
  add_paths(*command, options->paths);
  add_camera(*command, options->camera);
  command
      ->add_option(
          "--spp", options->samples,
          "Samples per pixel of the pictures, and of those on which a pair is compared where it finds different "
          "paths; of whitted rounded up to a multiple of 16")
      ->check(whole(2, 1 << 20))
      ->capture_default_str();
  command
      ->add_option(
          "--replications", options->replications,
          "Small runs of other seeds, by which the mean z is judged, with as many samples again in all, and nearly as "
          "much time; 0: none")
      ->check(whole(0, 4096))
      ->capture_default_str();
  add_no_pictures(*command, options->pictures,
                  "Draw no pictures: no PNG, and no EXR; they take the longer the more pixels a camera has, by --spp");
  add_intersector(*command, options->intersector, "Ray caster");
}

void add_view_factors(CLI::App& app, Command& chosen) {
  auto options = std::make_shared<ViewFactorOptions>();
  CLI::App* command = add_command<ViewFactorOptions>(
      app, "view-factors", "View factors of a mesh or scene, with an error on each",
      core::format("interflect view-factors %s -o F.h5 --element-size 0.1", example_scene), view_factors, options,
      chosen);
  command->add_option("FILE", options->input, "OBJ, PLY, STL, glTF, VTU, VTP, View3D's .vs3, or a scene (.json)")
      ->check(named("a file"))
      ->required();
  CLI::Option* out = command
                         ->add_option("-o,--out", options->out,
                                      "F.h5, F.npz, F.mtx or F.csv; the others are made from an .h5 beside them")
                         ->required();
  add_forecast(*command, options->forecast_only, out);
  add_effort(*command, *options);
  add_form_factors(*command, options->form_factors);
  add_closure(*command, options->closure);
  add_element_size(*command, options->element_size, "one element a face");
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
      ->check(named("a surface or group"));
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
  add_folder(*command, options->out, "the table and the plot");
  add_element_size(*command, options->element_size, "that of solve");
  command->add_option("--tolerance", options->tolerance, "Largest sum of a row's errors in the reference")
      ->check(within(1e-9, 0.5))
      ->capture_default_str();
}

void add_solvers(CLI::App& app, Command& chosen) {
  add_command<SolversOptions>(app, "solvers", "The linear solvers: which ones sample, and which ones solve takes",
                              "interflect solvers", solvers, std::make_shared<SolversOptions>(), chosen);
}

void add_integrators(CLI::App& app, Command& chosen) {
  add_command<ListOptions>(app, "integrators",
                           "The Monte Carlo integrators: what they promise, which paths of light they find and miss",
                           "interflect integrators", integrators, std::make_shared<ListOptions>(), chosen);
}

void add_compare_solvers(CLI::App& app, Command& chosen) {
  auto options = std::make_shared<CompareSolversOptions>();
  CLI::App* command = add_command<CompareSolversOptions>(
      app, "compare-solvers", "Several linear solvers on one scene: error against work and time",
      core::format("interflect compare-solvers %s --solvers jacobi conjugate-gradients progressive -o out/solvers",
                   example_scene),
      compare_solvers, options, chosen);
  add_scene(*command, options->scene);
  add_folder(*command, options->out,
             "the table and the plots: error against sweeps, against rays of those that sample, and against time");
  command
      ->add_option("--solvers", options->solvers,
                   "Which ones; default: all but `automatic`, which is one of them, and without --goal those for one "
                   "number (interflect solvers)")
      ->check(CLI::IsMember(solvers::solver_names()));
  command
      ->add_option("--goal", options->goal,
                   "One number that is asked for: a sensor, a surface, or camera:NAME; errors are of it then, and what "
                   "each solver makes it is told")
      ->check(named("a sensor, a surface or a camera"));
  add_equations(*command, options->settings);
}

void add_dim(CLI::App& app, Command& chosen) {
  auto options = std::make_shared<DimOptions>();
  CLI::App* command =
      add_command<DimOptions>(app, "dim", "Light groups of a solution at other outputs: no solve, all files anew",
                              "interflect dim out/office --group \"window side=40%\"   # of: interflect solve "
                              "data/scenes/office.json -o out/office "
                              "--light-groups",
                              dim, options, chosen);
  command->add_option("SOLUTION", options->solution, "Folder of a solve --light-groups")
      ->check(named("a folder"))
      ->required();
  command->add_option("--group", options->groups, "NAME=PART of its full output, 0.4 or 40%; of others all");
  command->add_option("-o,--out", options->out, "Folder for the results")
      ->check(named("a folder"))
      ->default_str("SOLUTION/dimmed");
  add_no_pictures(*command, options->pictures);
}

void add_shoot(CLI::App& app, Command& chosen) {
  auto options = std::make_shared<ShootOptions>();
  options->settings.solver = "progressive";
  options->settings.stopping.unshot = 0.01;
  CLI::App* command = add_command<ShootOptions>(
      app, "shoot", "Progressive refinement: pictures from the first shot on, and no matrix in memory",
      core::format("interflect shoot %s -o out/shots --element-size 0.02 --every 50 --unshot 5%%", example_scene),
      shoot, options, chosen);
  add_scene(*command, options->scene);
  add_folder(*command, options->out);
  command->add_option("--every", options->every, "Shots after which there is a picture and a .vtu; 0: at the end alone")
      ->check(whole(0, 1 << 30))
      ->capture_default_str();
  command
      ->add_option("--shots", options->shots,
                   "Shots, those before --resume included, after which it stops in any case: as many as the record of "
                   "a run says that was stopped give its result again")
      ->check(whole(1, std::numeric_limits<int>::max()))
      ->default_str("as many as it takes");
  command->add_flag("--resume", options->resume, "Go on from the checkpoint that an earlier run left in the folder");
  add_shooting(*command, options->settings);
  add_no_pictures(*command, options->pictures);
}

void add_exchange(CLI::App& app, Command& chosen) {
  auto options = std::make_shared<ExchangeOptions>();
  options->settings.form_factors = "analytic";
  CLI::App* command = add_command<ExchangeOptions>(
      app, "exchange", "Net radiative exchange of grey surfaces with temperatures or heat fluxes",
      "interflect exchange data/scenes/oven.json -o out/oven --environment 293.15", exchange, options, chosen);
  add_scene(*command, options->scene);
  add_folder(*command, options->out);
  command->add_option("--environment", options->environment, "Temperature of what openings look at [K]")
      ->check(within(0.0, 1e5))
      ->capture_default_str();
  add_element_size(*command, options->settings.element_size, "that of solve");
  add_form_factors(*command, options->settings.form_factors);
  add_quadrature_tolerance(*command, options->settings.quadrature_tolerance, "a form factor");
  add_no_pictures(*command, options->pictures);
  add_closure(*command, options->settings.closure);
  add_effort(*command, options->settings);
}

void add_info(CLI::App& app, Command& chosen) {
  auto options = std::make_shared<InfoOptions>();
  add_scene(*add_command<InfoOptions>(
                app, "info", "What was read: surfaces, materials, lights, flux, box in metres, cameras, repairs",
                core::format("interflect info %s", example_scene), info, options, chosen),
            options->scene);
}

void add_check(CLI::App& app, Command& chosen) {
  auto options = std::make_shared<CheckOptions>();
  add_scene(*add_command<CheckOptions>(app, "check",
                                       "Looks for gaps, flipped normals, duplicate and coplanar faces, and openings",
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
                   "Exit status: 0 done, 1 done but not as hoped (not validated, findings, stopped), 2 bad input.\n"
                   "Each command has its own --help with an example.",
                   example_scene));
  add_common(app, command.common);
  add_solve(app, command);
  add_validate(app, command);
  add_render(app, command);
  add_trace(app, command);
  add_compare(app, command);
  add_view_factors(app, command);
  add_compare_form_factors(app, command);
  add_solvers(app, command);
  add_integrators(app, command);
  add_compare_solvers(app, command);
  add_shoot(app, command);
  add_dim(app, command);
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

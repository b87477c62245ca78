#pragma once

#include <filesystem>
#include <string>

#include "apps/options.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

/// Options that several commands have, alone or in groups.  Help lists them in the order in which they were added.
namespace interflect::apps {

/// Of every command: seed, threads, and how much is said.
void add_common(CLI::App& app, CommonOptions& common);

void add_scene(CLI::App& command, std::filesystem::path& scene);
void add_camera(CLI::App& command, std::string& camera);
CLI::Option* add_folder(CLI::App& command, std::filesystem::path& out, const std::string& what = "the results");
void add_no_pictures(CLI::App& command, bool& pictures, const std::string& description = "Write no PNG");

/// @param out  where the results go, which a forecast does not need
void add_forecast(CLI::App& command, bool& forecast_only, CLI::Option* out);

/// @param when_none  what elements are where no size is given
void add_element_size(CLI::App& command, double& size, const std::string& when_none);
CLI::Option* add_form_factors(CLI::App& command, std::string& method);
void add_quadrature_tolerance(CLI::App& command, double& tolerance, const std::string& of);
void add_closure(CLI::App& command, std::string& closure);
void add_intersector(CLI::App& command, std::string& intersector, const std::string& description);
/// Of every measurement, by `compare`.
void add_target(CLI::App& command, double& target);
/// Paths of light that count, in Heckbert's notation.
void add_paths(CLI::App& command, std::string& paths);
void add_accuracy(CLI::App& command, double& accuracy, const std::string& of);

/// How a picture is traced: samples, filter, sequence, and when it ends.
void add_sampling(CLI::App& command, TraceOptions& options);
/// How it outlives its run.
void add_checkpoint(CLI::App& command, TraceOptions& options);

/// How much a form-factor method does: a row's error, samples, cells, rays.  What is not heeded is refused
/// (heeded_options.h).
void add_effort(CLI::App& command, fem::RadiositySettings& settings);
void add_effort(CLI::App& command, ViewFactorOptions& options);

/// Elements, form factors and solver of a radiosity solution, and what it is for.
/// @param out  where the results go
void add_radiosity(CLI::App& command, SolveOptions& options, CLI::Option* out);

/// Elements and form factors of progressive refinement, and when it stops.
void add_shooting(CLI::App& command, fem::RadiositySettings& settings);

/// Elements and form factors, and when a solver stops: all that equations are made by, but for what they are for.
void add_equations(CLI::App& command, fem::RadiositySettings& settings);

}  // namespace interflect::apps

#pragma once

#include <string>

#include "apps/solved_scene.h"
#include "results/record.h"
#include "results/tables.h"

namespace interflect::apps {

/// What was asked for, and what the form factors came to.
results::Record settings_record(const fem::RadiositySettings& settings, const fem::RadiositySolution& solution);
results::Record form_factor_record(const fem::RadiositySolution& solution);

/// What summary.json says of a run: enough to repeat it and to judge it.  Whether it was stopped, and its peak memory,
/// are as of now.
results::Record summary_record(const SolvedScene& solved, const SolveOptions& options, const CommonOptions& common,
                               const Run& run);
void write_summary(const SolvedScene& solved, const SolveOptions& options, const CommonOptions& common, const Run& run);

/// solution.vtu alone, and with surfaces.csv and sensors.csv; the pictures where they are wanted.
void write_field(const SolvedScene& solved, const std::filesystem::path& folder, bool pictures);
void write_tables_and_field(const SolvedScene& solved, const std::filesystem::path& folder, bool pictures);

/// solution.vtu, surfaces.csv, sensors.csv, summary.json and the pictures, into options.out.
void write_solution(const SolvedScene& solved, const SolveOptions& options, const CommonOptions& common,
                    const Run& run);

/// How wrong irradiance is on the whole.
std::string irradiance_text(const SolvedScene& solved);

/// Sensors, a line each, if there are any; then the means of all surfaces and of sensors with their errors:
/// "E_avg(desk) = 312.4 lx, error <= 0.8 lx (0.26 %, estimated)".
std::string means_text(const SolvedScene& solved);

/// The short table of a solve: elements, energy, error, sensors, time of each stage.
std::string solution_text(const SolvedScene& solved);

}  // namespace interflect::apps

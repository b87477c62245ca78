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

/// solution.vtu, surfaces.csv, sensors.csv, summary.json and the pictures, into options.out.
void write_solution(const SolvedScene& solved, const SolveOptions& options, const CommonOptions& common,
                    const Run& run);

/// The short table of a solve: elements, energy, error, sensors, time of each stage.
std::string solution_text(const SolvedScene& solved);

}  // namespace interflect::apps

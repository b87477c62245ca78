#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "apps/solved_scene.h"
#include "validation/certificate.h"

namespace interflect::apps {

// What is judged comes in the order of the questions: the parts of the mesh first (apps/questions.h).

/// The tables and fields beside the certificate: validation.vtu, traced_surfaces.csv, traced_sensors.csv.
void write_traced(const SolvedScene& solved, std::span<const validation::Judged> judged,
                  const validation::Certificate& certificate, const std::filesystem::path& out);

/// validation.json, and summary.json again: both say whether the run was stopped.  Returns what validation.json holds.
results::Record write_records(const SolvedScene& solved, std::span<const validation::Judged> judged,
                              const validation::Certificate& certificate, const ValidateOptions& options,
                              const CommonOptions& common, const Run& run);

/// Table, reasons, remarks, verdict.
std::string certificate_text(const validation::Certificate& certificate);

}  // namespace interflect::apps

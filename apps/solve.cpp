#include <cstdio>

#include "apps/commands.h"
#include "apps/read_scene.h"
#include "apps/solution_files.h"

namespace interflect::apps {

namespace {

/// With --forecast, what the solve will need is the result.
ExitStatus print_forecast(const SolveOptions& options, const CommonOptions& common, const Run& run) {
  const fem::Forecast forecast = fem::forecast(read_and_note(options.scene), options.settings, run);
  std::printf("%s\n", common.json ? results::json_text(forecast_record(forecast)).c_str() : describe(forecast).c_str());
  return success;
}

}  // namespace

ExitStatus solve(const SolveOptions& options, const CommonOptions& common, Run& run) {
  if (options.forecast_only) return print_forecast(options, common, run);
  const auto solved = solve_scene(options, common, run);
  write_solution(*solved, options, common, run);
  if (common.json)
    std::printf("%s\n", results::json_text(summary_record(*solved, options, common, run)).c_str());
  else if (!common.quiet)
    std::printf("%s\nwritten to %s\n", solution_text(*solved).c_str(), options.out.string().c_str());
  return shortfalls_of(solved->solution, options.settings).empty() ? success : not_met;
}

}  // namespace interflect::apps

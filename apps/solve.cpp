#include <cstdio>

#include "apps/commands.h"
#include "apps/equation_residual.h"
#include "apps/light_group_files.h"
#include "apps/proved_bounds.h"
#include "apps/solution_files.h"

namespace interflect::apps {

ExitStatus solve(const SolveOptions& options, const CommonOptions& common, Run& run) {
  if (options.forecast_only) return print_forecast(options, common, run);
  const auto solved = solve_scene(scene_to_solve(options), options, common, run);
  if (options.bounds) {
    solved->bounds = proved_bounds(*solved, options.settings.max_memory, run);
    if (!solved->bounds) solved->warnings.emplace_back("stopped before its bounds were found: there are none");
  }
  if (options.residual) solved->residual = equation_residual(*solved, run);
  write_solution(*solved, options, common, run);
  Run to_the_end = run.to_the_end();  // what there is of a run that was stopped is written, groups and all
  if (options.settings.light_groups) write_light_groups(*solved, options.out, to_the_end);
  if (common.json)
    std::printf("%s\n", results::json_text(summary_record(*solved, options, common, run)).c_str());
  else if (!common.quiet)
    std::printf("%s\nwritten to %s\n", solution_text(*solved).c_str(), options.out.string().c_str());
  const bool all_found = (!options.bounds || solved->bounds) && (!options.residual || solved->residual);
  return all_found && shortfalls_of(solved->solution, options.settings).empty() ? success : not_met;
}

}  // namespace interflect::apps

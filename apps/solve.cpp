#include <cstdio>

#include "apps/commands.h"
#include "apps/solution_files.h"
#include "core/log.h"

namespace interflect::apps {

ExitStatus solve(const SolveOptions& options, const CommonOptions& common, Run& run) {
  const auto solved = solve_scene(options, common, run);
  if (!solved) return success;
  write_solution(*solved, options, common);
  if (common.json)
    std::printf("%s\n", results::json_text(summary_record(*solved, options, common)).c_str());
  else if (!common.quiet)
    std::printf("%s\nwritten to %s\n", solution_text(*solved).c_str(), options.out.string().c_str());
  if (solved->solution.solver.converged()) return success;
  core::log::warning("the solver has not converged: " + solvers::describe(solved->solution.solver.why));
  return not_met;
}

}  // namespace interflect::apps

#include "solvers/solver.h"

#include <cstdio>

#include "apps/commands.h"
#include "results/record.h"

namespace interflect::apps {

ExitStatus solvers(const SolversOptions&, const CommonOptions& common, Run&) {
  results::Record::List list;
  std::size_t widest = 0;
  for (const solvers::SolverEntry& each : solvers::known_solvers()) widest = std::max(widest, each.name.size());
  for (const solvers::SolverEntry& each : solvers::known_solvers()) {
    list.push_back(results::Record().add("name", each.name).add("summary", each.summary));
    if (!common.json) std::printf("%-*s  %s\n", static_cast<int>(widest), each.name.c_str(), each.summary.c_str());
  }
  if (common.json) std::printf("%s\n", results::json_text(results::Record().add("solvers", std::move(list))).c_str());
  return success;
}

}  // namespace interflect::apps

#include "solvers/solver.h"

#include <algorithm>
#include <cstdio>

#include "apps/commands.h"
#include "results/record.h"

namespace interflect::apps {
namespace {

using solvers::SolverEntry;
using Needs = SolverEntry::Needs;

/// Which solves take it, in a word or two; `legend` has what they stand for.
const char* in_solve(const SolverEntry& solver) {
  switch (solver.needs) {
    case Needs::symmetry:
      return "not at nodes";
    case Needs::lines:
      return "no mirrors";
    case Needs::closed_room:
      return "closed rooms";
    case Needs::target:
      return "no";
    default:
      return solver.finds_black_instead.empty() ? "yes" : "nothing black";
  }
}

constexpr const char* legend = R"(
works by  matrix  on the form factors of all pairs of elements: no noise
          rays    it samples: no matrix and no form factors, constants as elements' functions, and results with noise,
                  as little as --noise asks for
in solve  whether interflect solve --solver takes it; compare-solvers takes all
          not at nodes   its matrix has to be symmetric, which only --projection galerkin makes
          no mirrors     its lines go straight: scenes with mirrors or smooth glass are refused
          closed rooms   the same, and scenes that light can leave are refused
          nothing black  scenes are refused in which something reflects nothing
          no             it finds one number, not a solution: interflect compare-solvers --goal NAME --solvers ...
)";

}  // namespace

ExitStatus solvers(const SolversOptions&, const CommonOptions& common, Run&) {
  results::Record::List list;
  std::size_t widest = 0;
  for (const SolverEntry& each : solvers::known_solvers()) widest = std::max(widest, each.name.size());
  const auto print = [&](const char* name, const char* works_by, const char* solve, const char* summary) {
    std::printf("%-*s  %-8s  %-13s  %s\n", static_cast<int>(widest), name, works_by, solve, summary);
  };
  if (!common.json) print("solver", "works by", "in solve", "what it does");
  for (const SolverEntry& each : solvers::known_solvers()) {
    list.push_back(results::Record()
                       .add("name", each.name)
                       .add("summary", each.summary)
                       .add("samples", each.samples())
                       .add("solve_takes_it", each.needs != Needs::target)
                       .add("in_solve", in_solve(each)));
    if (!common.json)
      print(each.name.c_str(), each.samples() ? "rays" : "matrix", in_solve(each), each.summary.c_str());
  }
  if (common.json)
    std::printf("%s\n", results::json_text(results::Record().add("solvers", std::move(list))).c_str());
  else
    std::fputs(legend, stdout);
  return success;
}

}  // namespace interflect::apps

#include "solvers/gauss_seidel.h"

#include <memory>

#include "solvers/bounce.h"
#include "solvers/iterations.h"
#include "solvers/row_sweeps.h"
#include "solvers/system_check.h"
#include "solvers/tile_sweeps.h"

namespace interflect::solvers {
namespace {

std::unique_ptr<Sweeps> sweeps_of(const System& system, const RowAccess& rows, double relaxation,
                                  const ColumnMatrix& start, const Run& run) {
  if (const TileAccess* tiles = system.K.tiles())
    return std::make_unique<TileSweeps>(system, *tiles, relaxation, start, run);
  return std::make_unique<RowSweeps>(system, rows, relaxation, start, run);
}

}  // namespace

std::string GaussSeidel::name() const {
  if (sweep_ == Sweep::back_and_forth) return "symmetric-gauss-seidel";
  return relaxation_ == 1 ? "gauss-seidel" : "over-relaxation";
}

SolverReport GaussSeidel::advance(const System& system, SolverState& state, const StoppingRule& rule, Run& run) const {
  const RowAccess& rows = required_rows(system, name());
  require_solvable(system);
  if (!prepare(system, state)) return {.why = SolverReport::Stopped::nothing_to_do};

  const auto n = static_cast<double>(state.x.rows());
  const bool back_too = sweep_ == Sweep::back_and_forth;
  const std::unique_ptr<Sweeps> sweeps = sweeps_of(system, rows, relaxation_, state.x, run);
  Iterations iterations(state, rule, run);
  for (bool more = true; more;) {
    if (back_too) sweeps->back();
    sweeps->forward();
    ColumnMatrix x = sweeps->radiosity();
    const ColumnMatrix residual = system.K.symmetric() ? sweeps->residual() : residual_of(system, x, run);
    more = iterations.next(x, {relative_size(residual, x), (back_too ? 2 : 1) * n});
  }
  return iterations.report();
}

}  // namespace interflect::solvers

#pragma once

#include "solvers/sweeps.h"

namespace interflect::solvers {

/// Sweeps over rows that are fetched, each once a sweep, a block of them at a time.
class RowSweeps final : public Sweeps {
 public:
  RowSweeps(const System& system, const RowAccess& rows, double relaxation, const ColumnMatrix& start, const Run& run);
  void forward() override;
  void back() override;

 private:
  void sweep_rows(Index first, bool ascending);
  void fetch_and_sum(Index first, Index count);
  void spread(Index begin, Index end, Index count);

  const RowAccess& access_;
  const Run& run_;
  ColumnMatrix rows_;  ///< of the block at work
  ColumnMatrix sums_;  ///< columns x rows of a block
};

}  // namespace interflect::solvers

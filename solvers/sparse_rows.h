#pragma once

#include <vector>

#include "core/vec.h"

namespace interflect::solvers {

struct RowEntry {
  Index unknown;
  double K;
};

/// Rows of a K that stores few of its entries, for solvers that go by rows and need not touch the others.
class SparseRows {
 public:
  virtual ~SparseRows() = default;
  /// Entries of a row that are stored, by unknown, ascending.
  virtual void row(Index a, std::vector<RowEntry>& out) const = 0;
};

}  // namespace interflect::solvers

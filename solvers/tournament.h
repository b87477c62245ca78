#pragma once

#include <vector>

#include "core/vec.h"

namespace interflect::solvers {

/// Who has the largest of many numbers, while a few of them change: a heap whose leaves stay where they are.  A match
/// of two has a winner, of equal ones the first; a change is log2 of their number of matches played again.  What is no
/// number wins over all.
class Tournament {
 public:
  /// All 0.
  explicit Tournament(Index players);
  void set(Index player, double value);
  Index winner() const { return winners_[1]; }
  double largest() const { return values_[static_cast<std::size_t>(winner())]; }

 private:
  Index better(Index a, Index b) const;

  Index leaves_;  ///< a power of two
  std::vector<double> values_;
  std::vector<Index> winners_;  ///< of node k: of its children 2 k and 2 k + 1; leaves are not kept
};

}  // namespace interflect::solvers

#pragma once

#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "core/vec.h"

namespace interflect::fem {

/// What errors of form factors add up to in each row, e_a = sum_b e_ab / A_a, from many threads at once.
///
/// Sums are integers, in units of 2^-52, every entry rounded up: the same for any number of threads.
class RowTally {
 public:
  explicit RowTally(std::span<const double> areas) : areas_(areas), sum_(areas.size()) {}

  /// @param error  of K_ab = K_ba [m²], not negative
  void add(Index a, double error);

  double of(Index a) const;
  std::vector<double> all() const;
  void clear(Index a) { sum_[static_cast<std::size_t>(a)].store(0, std::memory_order_relaxed); }

 private:
  std::span<const double> areas_;
  std::vector<std::atomic<std::uint64_t>> sum_;
};

}  // namespace interflect::fem

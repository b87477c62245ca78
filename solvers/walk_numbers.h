#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "core/random.h"
#include "core/sample_sequence.h"
#include "solvers/solver.h"

namespace interflect::solvers {

/// The numbers of a walk: the first ones by a sequence, which may be evenly spread, all others independent.
class WalkNumbers {
 public:
  static constexpr std::size_t most = 8;  ///< at once, and by a sequence

  WalkNumbers(const core::SampleSequence& sequence, std::uint64_t index, core::RandomNumbers others, std::size_t first)
      : others_(others), size_(first) {
    sequence.point(index, std::span(numbers_).first(first));
  }
  /// Valid until the next call.
  std::span<const double> next(std::size_t count) {
    if (used_ + count > size_) {
      used_ = 0, size_ = count;
      for (std::size_t k = 0; k < count; ++k) numbers_[k] = others_.next();
    }
    used_ += count;
    return std::span<const double>(numbers_).subspan(used_ - count, count);
  }

 private:
  core::RandomNumbers others_;
  std::array<double, most> numbers_;
  std::size_t size_, used_ = 0;
};

/// Those of the walks of all replications.
class WalkSequences {
 public:
  /// @param first  how many numbers of a walk are by the sequence
  WalkSequences(const SolverSettings& settings, std::uint64_t seed, std::size_t first);
  /// Of walk k of a replication, or of the walk k that starts at an unknown.  Beyond 2^20 walks an unknown some of two
  /// unknowns have the same numbers: each has the right mean all the same.
  WalkNumbers operator()(int replication, std::uint64_t k, Index unknown = 0) const;

 private:
  std::uint64_t seed_;
  std::size_t first_;
  std::vector<std::unique_ptr<core::SampleSequence>> sequences_;
};

}  // namespace interflect::solvers

#pragma once

#include <memory>
#include <vector>

#include "core/sample_sequence.h"
#include "solvers/solver.h"

namespace interflect::solvers {

/// The numbers of walks: the first ones of each by a sequence, which may be evenly spread, all others independent.
struct WalkNumbers {
  const core::SampleSequence& sequence;  ///< its point w is of walk w
  std::uint64_t seed;                    ///< of the others
  std::uint32_t stream;
  std::size_t first;     ///< how many are by the sequence
  std::size_t used = 0;  ///< of those, by whoever starts the walk
};

/// Those of the walks of all replications.
class WalkSequences {
 public:
  /// @param first  how many numbers of a walk are by the sequence
  /// @param used   of those, by whoever starts walks
  WalkSequences(const SolverSettings& settings, std::uint64_t seed, std::size_t first, std::size_t used = 0);
  /// Of a replication.
  WalkNumbers operator()(int replication) const;
  /// The walk k, or the walk k that starts at an unknown.  Beyond 2^20 walks an unknown some of two unknowns have the
  /// same numbers: each has the right mean all the same.
  static std::uint64_t walk(std::uint64_t k, Index unknown = 0) {
    return static_cast<std::uint64_t>(unknown) << 20 | k;
  }

 private:
  std::uint64_t seed_;
  std::size_t first_, used_;
  std::vector<std::unique_ptr<core::SampleSequence>> sequences_;
};

}  // namespace interflect::solvers

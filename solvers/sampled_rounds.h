#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "core/sample_sequence.h"
#include "solvers/solver.h"

namespace interflect::solvers {

/// How a solver samples: twice as much in each round, in independent replications, until the noise is small.
struct SampledRounds {
  std::uint64_t first;            ///< samples of a replication in the first round
  std::uint64_t starts_a_sample;  ///< how many StoppingRule::samples each is
  /// Samples begin .. end of a replication: what the radiosity has beyond e, summed over them.  From any thread, one at a
  /// time of each replication.  @return  draws of the TransitionSampler
  std::function<std::uint64_t(int replication, std::uint64_t begin, std::uint64_t end, ColumnMatrix& sum)> add;
};
/// x and its standard errors, round after round.  @throws core::InputError  fewer than 10 replications
SolverReport sample_in_rounds(const System& system, SolverState& state, const StoppingRule& rule,
                              const SolverSettings& settings, const SampledRounds& rounds, Run& run);

/// One a replication, of a purpose of its own.
std::vector<std::unique_ptr<core::SampleSequence>> sequences_for(const SolverSettings& settings, std::uint64_t seed);

}  // namespace interflect::solvers

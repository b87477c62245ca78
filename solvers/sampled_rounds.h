#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "core/sample_sequence.h"
#include "solvers/iterations.h"
#include "solvers/solver.h"

namespace interflect::solvers {

/// Lets a round be given up where it is asked to stop, or out of time.
class RoundStop {
 public:
  struct Asked {};
  explicit RoundStop(const Iterations& iterations) : iterations_(iterations) {}
  /// @throws Asked
  void here() const {
    if (iterations_.interrupted()) throw Asked();
  }
  /// Now and then.
  void here(std::uint64_t sample) const {
    if (sample % 1024 == 0) here();
  }

 private:
  const Iterations& iterations_;
};

/// How a solver samples: twice as much in each round, in independent replications, until the noise is small.
struct SampledRounds {
  std::uint64_t first;            ///< samples of a replication in the first round
  std::uint64_t starts_a_sample;  ///< how many StoppingRule::samples each is
  /// Samples begin .. end of a replication: what the radiosity has beyond e, summed over them.  From any thread, one at
  /// a time of each replication.  @return  draws of the TransitionSampler
  std::function<std::uint64_t(int replication, std::uint64_t begin, std::uint64_t end, ColumnMatrix& sum,
                              const RoundStop& stop)>
      add;
  /// Before each round, of all replications: what they sample by may get better.  @return  draws
  std::function<std::uint64_t(std::uint64_t begin, std::uint64_t end, const RoundStop& stop)> prepare{};
  std::vector<Index> unanswered{};  ///< unknowns that nothing is said of: their standard errors are infinite
};
/// x and its standard errors, round after round.  Stopped before there is any, x is e, with infinite errors.
/// @throws core::InputError  fewer than 10 replications
SolverReport sample_in_rounds(const System& system, SolverState& state, const StoppingRule& rule,
                              const SolverSettings& settings, const SampledRounds& rounds, Run& run);

/// One a replication, of a purpose of its own.
std::vector<std::unique_ptr<core::SampleSequence>> sequences_for(const SolverSettings& settings, std::uint64_t seed);

}  // namespace interflect::solvers

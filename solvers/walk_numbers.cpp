#include "solvers/walk_numbers.h"

#include "solvers/sampled_rounds.h"

namespace interflect::solvers {

WalkSequences::WalkSequences(const SolverSettings& settings, std::uint64_t seed, std::size_t first, std::size_t used)
    : seed_(seed), first_(first), used_(used), sequences_(sequences_for(settings, seed)) {}

WalkNumbers WalkSequences::operator()(int replication) const {
  return {*sequences_[static_cast<std::size_t>(replication)], seed_, static_cast<std::uint32_t>(1 + replication),
          first_, used_};
}

}  // namespace interflect::solvers

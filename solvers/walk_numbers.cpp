#include "solvers/walk_numbers.h"

#include "solvers/sampled_rounds.h"

namespace interflect::solvers {

WalkSequences::WalkSequences(const SolverSettings& settings, std::uint64_t seed, std::size_t first)
    : seed_(seed), first_(first), sequences_(sequences_for(settings, seed)) {}

WalkNumbers WalkSequences::operator()(int replication, std::uint64_t k, Index unknown) const {
  const std::uint64_t index = static_cast<std::uint64_t>(unknown) << 20 | k;
  const auto r = static_cast<std::size_t>(replication);
  return {*sequences_[r], index, {seed_, static_cast<std::uint32_t>(1 + replication), index}, first_};
}

}  // namespace interflect::solvers

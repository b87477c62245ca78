#include "core/sequence/shifted_sobol.h"

#include <algorithm>

#include "core/sequence/independent.h"

namespace interflect::core {

ShiftedSobol::ShiftedSobol(std::uint64_t seed)
    : seed_(seed), sobol_(Sobol::scrambled(seed)), shift_{random_block(seed, 1, 0, 0), random_block(seed, 1, 0, 1)} {}

void ShiftedSobol::numbers(std::uint64_t k, std::size_t first, std::span<double> u) const {
  constexpr std::size_t dimensions = Sobol::dimensions;
  const std::size_t spread = first < dimensions ? std::min(u.size(), dimensions - first) : 0;
  if (spread > 0) {
    const auto x = sobol_.point<dimensions>(static_cast<std::uint32_t>(k));
    for (std::size_t i = 0, d = first; i < spread; ++i, ++d) u[i] = inside_unit(x[d] ^ shift_[d / 4][d % 4]);
  }
  if (spread < u.size()) independent_numbers(seed_, k, first + spread, u.subspan(spread));
}

std::unique_ptr<SampleSequence> ShiftedSobol::replicate(std::uint64_t number) const {
  return std::make_unique<ShiftedSobol>(seed_of_replication(seed_, number));
}

}  // namespace interflect::core

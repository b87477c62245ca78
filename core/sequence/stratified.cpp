#include "core/sequence/stratified.h"

#include "core/sequence/independent.h"
#include "core/sequence/strata.h"

namespace interflect::core {

void StratifiedSequence::numbers(std::uint64_t k, std::size_t first, std::span<double> u) const {
  constexpr std::uint32_t side = 1u << (strata_bits / 2);
  static_assert(side * side == strata);
  independent_numbers(seed_, k, first, u);
  std::uint32_t square = 0;
  for (std::size_t i = 0; i < u.size(); ++i) {
    const std::size_t d = first + i;
    if (i == 0 || d % 2 == 0) square = stratum_of(seed_, static_cast<std::uint32_t>(d / 2), k);
    u[i] = in_stratum(d % 2 == 0 ? square % side : square / side, side, u[i]);
  }
}

std::unique_ptr<SampleSequence> StratifiedSequence::replicate(std::uint64_t number) const {
  return std::make_unique<StratifiedSequence>(seed_of_replication(seed_, number));
}

}  // namespace interflect::core

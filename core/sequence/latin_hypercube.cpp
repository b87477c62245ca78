#include "core/sequence/latin_hypercube.h"

#include "core/sequence/independent.h"
#include "core/sequence/strata.h"

namespace interflect::core {

void LatinHypercube::numbers(std::uint64_t k, std::size_t first, std::span<double> u) const {
  independent_numbers(seed_, k, first, u);
  for (std::size_t i = 0; i < u.size(); ++i)
    u[i] = in_stratum(stratum_of(seed_, static_cast<std::uint32_t>(first + i), k), strata, u[i]);
}

std::unique_ptr<SampleSequence> LatinHypercube::replicate(std::uint64_t number) const {
  return std::make_unique<LatinHypercube>(seed_of_replication(seed_, number));
}

}  // namespace interflect::core

#pragma once

#include <algorithm>
#include <cstdint>

#include "core/random.h"

/// The strata of sequences that fill as many in a random order with each block of points.
namespace interflect::core {

constexpr std::uint32_t strata_bits = 12, strata = 1u << strata_bits;

/// One of many permutations of the strata: each step, modulo their number, can be undone.
constexpr std::uint32_t permuted_stratum(std::uint32_t k, const RandomBlock& key) {
  constexpr std::uint32_t mask = strata - 1;
  for (const std::uint32_t word : key) {
    k = (k + word) & mask;
    k = (k * (2 * (word >> strata_bits) + 1)) & mask;
    k ^= k >> (strata_bits / 2);
    k ^= (word >> (32 - strata_bits)) & mask;
  }
  return k;
}

/// The stratum of point k, in an order of its own for each block of points and each `stream`.
constexpr std::uint32_t stratum_of(std::uint64_t seed, std::uint32_t stream, std::uint64_t k) {
  return permuted_stratum(static_cast<std::uint32_t>(k) & (strata - 1),
                          random_block(seed, 1 + stream, k >> strata_bits, 0));
}

/// The place u of a stratum of so many; below 1 where the sum is rounded up.
constexpr double in_stratum(std::uint32_t stratum, std::uint32_t of, double u) {
  return std::min((stratum + u) / of, 0x1.fffffffffffffp-1);
}

}  // namespace interflect::core

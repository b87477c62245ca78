#pragma once

#include <array>
#include <cstdint>

#include "core/random.h"

namespace interflect::test {

/// Four numbers in [0, 1) for each k of each stream.
inline std::array<double, 4> numbers_of(std::uint32_t stream, std::uint64_t k) {
  core::RandomNumbers numbers(11, stream, k);
  std::array<double, 4> u;
  for (double& each : u) each = numbers.next();
  return u;
}

}  // namespace interflect::test

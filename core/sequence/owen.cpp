#include "core/sequence/owen.h"

#include "core/random.h"

namespace interflect::core {

std::uint32_t owen_scrambled_exactly(std::uint32_t word, std::uint64_t seed, std::uint32_t dimension) {
  std::uint32_t flips = 0;
  for (std::uint32_t b = 0; b < 32; ++b) {
    const std::uint64_t before = b == 0 ? 0 : word >> (32 - b);
    flips |= (random_block(seed, dimension, std::uint64_t{b} << 32 | before, 0)[0] & 1u) << (31 - b);
  }
  return word ^ flips;
}

}  // namespace interflect::core

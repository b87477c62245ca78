#include "core/random.h"

#include <algorithm>
#include <bit>

namespace interflect::core {
namespace {

constexpr std::size_t lanes = 32;  ///< samples that are computed together: enough for a loop that compilers vectorise
using Words = std::array<std::uint32_t, lanes>;

/// philox() of as many counters as there are lanes, a step of all after the other, which compilers turn into vector
/// instructions.
void philox_of_all(std::array<Words, 4>& counter, std::uint64_t key) {
  auto k0 = static_cast<std::uint32_t>(key), k1 = static_cast<std::uint32_t>(key >> 32);
  auto& [c0, c1, c2, c3] = counter;
  for (int round = 0; round < 10; ++round) {
    for (std::size_t l = 0; l < lanes; ++l) {
      const std::uint64_t p0 = std::uint64_t{detail::philox_multiplier_0} * c0[l];
      const std::uint64_t p1 = std::uint64_t{detail::philox_multiplier_1} * c2[l];
      c0[l] = static_cast<std::uint32_t>(p1 >> 32) ^ c1[l] ^ k0;
      c1[l] = static_cast<std::uint32_t>(p1);
      c2[l] = static_cast<std::uint32_t>(p0 >> 32) ^ c3[l] ^ k1;
      c3[l] = static_cast<std::uint32_t>(p0);
    }
    k0 += detail::philox_weyl_0;
    k1 += detail::philox_weyl_1;
  }
}

/// random_block() of consecutive indices.
void random_blocks(std::uint64_t seed, std::uint32_t stream, std::uint64_t first, std::uint32_t block,
                   std::array<Words, 4>& words) {
  for (std::size_t l = 0; l < lanes; ++l) {
    words[0][l] = static_cast<std::uint32_t>(first + l);
    words[1][l] = static_cast<std::uint32_t>((first + l) >> 32);
    words[2][l] = stream, words[3][l] = block;
  }
  philox_of_all(words, seed);
}

}  // namespace

std::uint64_t derived_seed(std::uint64_t seed, std::string_view purpose) {
  std::uint64_t name = 0xCBF29CE484222325ull;  // FNV-1a
  for (char c : purpose) name = (name ^ static_cast<unsigned char>(c)) * 0x100000001B3ull;
  const RandomBlock mixed =
      philox({static_cast<std::uint32_t>(name), static_cast<std::uint32_t>(name >> 32), 0, 0}, seed);
  return (std::uint64_t{mixed[0]} << 32) | mixed[1];
}

std::uint64_t key_of(std::initializer_list<double> numbers) {
  std::uint64_t key = 0;
  for (const double number : numbers) {
    const auto bits = std::bit_cast<std::uint64_t>(number + 0.0);  // -0 + 0 is 0
    const RandomBlock mixed =
        philox({static_cast<std::uint32_t>(bits), static_cast<std::uint32_t>(bits >> 32), 0, 0}, key);
    key = (std::uint64_t{mixed[0]} << 32) | mixed[1];
  }
  return key;
}

void random_numbers(std::uint64_t seed, std::uint32_t stream, std::uint64_t first, std::size_t dimensions,
                    std::span<double> u) {
  const std::size_t samples = dimensions == 0 ? 0 : u.size() / dimensions;
  std::array<Words, 4> words;
  for (std::size_t k = 0; k < samples; k += lanes)
    for (std::size_t d = 0; d < dimensions; ++d) {
      if (d % 2 == 0) random_blocks(seed, stream, first + k, static_cast<std::uint32_t>(d / 2), words);
      const Words &high = words[d % 2 * 2], &low = words[d % 2 * 2 + 1];
      for (std::size_t l = 0; l < std::min(lanes, samples - k); ++l)
        u[(k + l) * dimensions + d] = uniform_53(high[l], low[l]);
    }
}

}  // namespace interflect::core

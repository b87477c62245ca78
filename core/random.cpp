#include "core/random.h"

#include <bit>

#include "core/random_kernels.h"
#include "core/wide_vectors.h"

namespace interflect::core {
namespace {

NumbersKernel best_kernel() {
#ifdef INTERFLECT_WIDE_RANDOM
  if (has_wide_vectors()) return wide_numbers_kernel();
#endif
  return numbers_of;
}

void numbers(const NumbersAsked& asked) {
  static const NumbersKernel kernel = best_kernel();
  kernel(asked);
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

RandomBlocks random_blocks(std::uint64_t seed, std::uint32_t stream, std::uint64_t index, std::uint32_t first) {
  static_assert(lanes == blocks_at_once);
  Counters words;
  for (std::size_t v = 0; v < together; ++v) {
    const std::uint64_t block = first + 4 * v;
    words[0][v] = Words{} + index, words[1][v] = words[0][v] >> 32;
    words[2][v] = Words{} + stream, words[3][v] = Words{block, block + 1, block + 2, block + 3};
  }
  philox_of_all(words, seed);
  RandomBlocks blocks;
  for (std::size_t w = 0; w < blocks.size(); ++w)
    for (std::size_t b = 0; b < blocks_at_once; ++b) blocks[w][b] = static_cast<std::uint32_t>(words[w][b / 4][b % 4]);
  return blocks;
}

void random_numbers(std::uint64_t seed, std::uint32_t stream, std::span<const std::uint64_t> indices, std::size_t first,
                    std::size_t count, std::span<double> u) {
  numbers({.seed = seed,
           .stream = stream,
           .samples = indices.size(),
           .indices = indices.data(),
           .first_index = 0,
           .first = first,
           .count = count,
           .u = u.data()});
}

void random_numbers(std::uint64_t seed, std::uint32_t stream, std::uint64_t first, std::size_t dimensions,
                    std::span<double> u) {
  numbers({.seed = seed,
           .stream = stream,
           .samples = dimensions == 0 ? 0 : u.size() / dimensions,
           .indices = nullptr,
           .first_index = first,
           .first = 0,
           .count = dimensions,
           .u = u.data()});
}

}  // namespace interflect::core

#include "core/random.h"

#include <algorithm>
#include <bit>
#include <cstring>

#ifdef __AVX2__
#include <immintrin.h>
#endif

namespace interflect::core {
namespace {

/// Words of four samples, each in the lower half of 64 bits: what the upper half holds does not matter, since products
/// are of the lower ones.
using Words [[gnu::vector_size(32)]] = std::uint64_t;
using Numbers [[gnu::vector_size(32)]] = double;
constexpr std::size_t together = 2;  ///< more do not fit the registers
constexpr std::size_t lanes = 4 * together;
using Counters = std::array<std::array<Words, together>, 4>;

// By reference: vectors as values have a calling convention of their own where registers are shorter.
inline void multiply(const Words& a, std::uint32_t by, Words& product) {
#ifdef __AVX2__
  product =
      reinterpret_cast<Words>(_mm256_mul_epu32(reinterpret_cast<__m256i>(a), _mm256_set1_epi64x(std::int64_t{by})));
#else
  product = (a & 0xFFFFFFFFu) * by;
#endif
}

/// philox() of as many counters as there are lanes, a step of all after the other.
void philox_of_all(Counters& counter, std::uint64_t key) {
  auto k0 = static_cast<std::uint32_t>(key), k1 = static_cast<std::uint32_t>(key >> 32);
  auto& [c0, c1, c2, c3] = counter;
  for (int round = 0; round < 10; ++round) {
    for (std::size_t v = 0; v < together; ++v) {
      Words p0, p1;
      multiply(c0[v], detail::philox_multiplier_0, p0);
      multiply(c2[v], detail::philox_multiplier_1, p1);
      c0[v] = p1 >> 32 ^ c1[v] ^ k0;
      c1[v] = p1;
      c2[v] = p0 >> 32 ^ c3[v] ^ k1;
      c3[v] = p0;
    }
    k0 += detail::philox_weyl_0;
    k1 += detail::philox_weyl_1;
  }
}

/// Of words of 32 bits: as the last bits of 2^52 + word.
inline void to_doubles(const Words& words, Numbers& numbers) {
  numbers = reinterpret_cast<Numbers>((words & 0xFFFFFFFFu) | 0x4330000000000000u) - 0x1p52;
}

/// uniform_53() of all: high 2^-32 + (low >> 11) 2^-53, which is exact.
void uniform_of_all(const std::array<Words, together>& high, const std::array<Words, together>& low,
                    std::array<double, lanes>& u) {
  for (std::size_t v = 0; v < together; ++v) {
    Numbers of_high, of_low;
    to_doubles(high[v], of_high);
    to_doubles((low[v] & 0xFFFFFFFFu) >> 11, of_low);
    const Numbers both = of_high * 0x1p-32 + of_low * 0x1p-53;
    std::memcpy(&u[4 * v], &both, sizeof both);
  }
}

/// Numbers first .. first + count - 1 of n samples: index(k) of the k-th.
template <class IndexOf>
void numbers_of(std::uint64_t seed, std::uint32_t stream, std::size_t n, const IndexOf& index, std::size_t first,
                std::size_t count, double* u) {
  Counters words;
  std::array<std::uint64_t, lanes> sample{};
  std::array<double, lanes> column;
  for (std::size_t k = 0; k < n; k += lanes) {
    const std::size_t used = std::min(lanes, n - k);
    for (std::size_t l = 0; l < used; ++l) sample[l] = index(k + l);
    for (std::size_t d = first; d < first + count; ++d) {
      if (d % 2 == 0 || d == first) {
        for (std::size_t v = 0; v < together; ++v) {
          std::memcpy(&words[0][v], &sample[4 * v], sizeof(Words));
          words[1][v] = words[0][v] >> 32, words[2][v] = Words{} + stream, words[3][v] = Words{} + d / 2;
        }
        philox_of_all(words, seed);
      }
      uniform_of_all(words[d % 2 * 2], words[d % 2 * 2 + 1], column);
      for (std::size_t l = 0; l < used; ++l) u[(k + l) * count + d - first] = column[l];
    }
  }
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
  numbers_of(
      seed, stream, indices.size(), [&](std::size_t k) { return indices[k]; }, first, count, u.data());
}

void random_numbers(std::uint64_t seed, std::uint32_t stream, std::uint64_t first, std::size_t dimensions,
                    std::span<double> u) {
  const std::size_t samples = dimensions == 0 ? 0 : u.size() / dimensions;
  numbers_of(
      seed, stream, samples, [&](std::size_t k) { return first + k; }, 0, dimensions, u.data());
}

}  // namespace interflect::core

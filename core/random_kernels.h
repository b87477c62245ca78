#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>

#include "core/random.h"

#ifdef __AVX2__
#include <immintrin.h>
#endif

/// The loops of `random_numbers`, which files with flags of their own make for several instruction sets: all in a
/// namespace without a name, so that none is taken for another.  The bits are the same with all.
namespace interflect::core {

/// Numbers first .. first + count - 1 of samples of a stream, sample after sample.
struct NumbersAsked {
  std::uint64_t seed;
  std::uint32_t stream;
  std::size_t samples;
  const std::uint64_t* indices;  ///< of the samples; null: first_index, first_index + 1, ..
  std::uint64_t first_index;
  std::size_t first, count;
  double* u;  ///< overwritten; count a sample

  std::uint64_t index(std::size_t k) const { return indices != nullptr ? indices[k] : first_index + k; }
};
using NumbersKernel = void (*)(const NumbersAsked& asked);

NumbersKernel wide_numbers_kernel();  ///< with vectors of 64 bytes, where INTERFLECT_WIDE_RANDOM

namespace {

#ifdef __AVX512F__
constexpr std::size_t vector_bytes = 64;
#else
constexpr std::size_t vector_bytes = 32;
#endif
constexpr std::size_t lanes = 8;  ///< samples that share each instruction
constexpr std::size_t vector_lanes = vector_bytes / 8, together = lanes / vector_lanes;

/// Words of samples, each in the lower half of 64 bits: what the upper half holds does not matter, since products are of
/// the lower ones.
using Words [[gnu::vector_size(vector_bytes)]] = std::uint64_t;
using Numbers [[gnu::vector_size(vector_bytes)]] = double;
using Counters = std::array<std::array<Words, together>, 4>;

// By reference: vectors as values have a calling convention of their own where registers are shorter.
inline void multiply(const Words& a, std::uint32_t by, Words& product) {
#if defined(__AVX512F__)
  product =
      reinterpret_cast<Words>(_mm512_mul_epu32(reinterpret_cast<__m512i>(a), _mm512_set1_epi64(std::int64_t{by})));
#elif defined(__AVX2__)
  product =
      reinterpret_cast<Words>(_mm256_mul_epu32(reinterpret_cast<__m256i>(a), _mm256_set1_epi64x(std::int64_t{by})));
#else
  product = (a & 0xFFFFFFFFu) * by;
#endif
}

/// philox() of as many counters as there are lanes, a step of all after the other.
inline void philox_of_all(Counters& counter, std::uint64_t key) {
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
inline void uniform_of_all(const std::array<Words, together>& high, const std::array<Words, together>& low,
                           std::array<double, lanes>& u) {
  for (std::size_t v = 0; v < together; ++v) {
    Numbers of_high, of_low;
    to_doubles(high[v], of_high);
    to_doubles((low[v] & 0xFFFFFFFFu) >> 11, of_low);
    const Numbers both = of_high * 0x1p-32 + of_low * 0x1p-53;
    std::memcpy(&u[vector_lanes * v], &both, sizeof both);
  }
}

inline void numbers_of(const NumbersAsked& asked) {
  const std::size_t n = asked.samples, first = asked.first, count = asked.count;
  Counters words;
  std::array<std::uint64_t, lanes> sample{};
  std::array<double, lanes> column;
  for (std::size_t k = 0; k < n; k += lanes) {
    const std::size_t used = std::min(lanes, n - k);
    for (std::size_t l = 0; l < used; ++l) sample[l] = asked.index(k + l);
    for (std::size_t d = first; d < first + count; ++d) {
      if (d % 2 == 0 || d == first) {
        for (std::size_t v = 0; v < together; ++v) {
          std::memcpy(&words[0][v], &sample[vector_lanes * v], sizeof(Words));
          words[1][v] = words[0][v] >> 32, words[2][v] = Words{} + asked.stream, words[3][v] = Words{} + d / 2;
        }
        philox_of_all(words, asked.seed);
      }
      uniform_of_all(words[d % 2 * 2], words[d % 2 * 2 + 1], column);
      for (std::size_t l = 0; l < used; ++l) asked.u[(k + l) * count + d - first] = column[l];
    }
  }
}

}  // namespace
}  // namespace interflect::core

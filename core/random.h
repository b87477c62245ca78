#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string_view>

/// Counter-based random numbers: a number is a pure function of what it serves (seed, stream, index, dimension), so
/// that any thread may draw it, in any order, and a run is repeated bit by bit.
///
/// Source: Philox4x32-10, [Salmon 2011] "Parallel random numbers: as easy as 1, 2, 3", SC'11, section 3.2.
/// Test: tests/core/random.cpp, by the published known answers.
namespace interflect::core {

using RandomBlock = std::array<std::uint32_t, 4>;

namespace detail {
constexpr std::uint32_t philox_multiplier_0 = 0xD2511F53u, philox_multiplier_1 = 0xCD9E8D57u;
constexpr std::uint32_t philox_weyl_0 = 0x9E3779B9u, philox_weyl_1 = 0xBB67AE85u;
}  // namespace detail

/// Ten rounds of Philox on a 128-bit counter with a 64-bit key.
constexpr RandomBlock philox(RandomBlock counter, std::uint64_t key) {
  auto k0 = static_cast<std::uint32_t>(key), k1 = static_cast<std::uint32_t>(key >> 32);
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t p0 = std::uint64_t{detail::philox_multiplier_0} * counter[0];
    const std::uint64_t p1 = std::uint64_t{detail::philox_multiplier_1} * counter[2];
    counter = {static_cast<std::uint32_t>(p1 >> 32) ^ counter[1] ^ k0, static_cast<std::uint32_t>(p1),
               static_cast<std::uint32_t>(p0 >> 32) ^ counter[3] ^ k1, static_cast<std::uint32_t>(p0)};
    k0 += detail::philox_weyl_0;
    k1 += detail::philox_weyl_1;
  }
  return counter;
}

/// Four numbers for sample `index` of `stream`; `dimension / 4` is `block`.
constexpr RandomBlock random_block(std::uint64_t seed, std::uint32_t stream, std::uint64_t index, std::uint32_t block) {
  return philox({static_cast<std::uint32_t>(index), static_cast<std::uint32_t>(index >> 32), stream, block}, seed);
}

/// random_block() of first, first + 1, .. at once: word w of block b is words[w][b].
constexpr std::size_t blocks_at_once = 8;
using RandomBlocks = std::array<std::array<std::uint32_t, blocks_at_once>, 4>;
RandomBlocks random_blocks(std::uint64_t seed, std::uint32_t stream, std::uint64_t index, std::uint32_t first);

/// A uniform number in [0, 1) with 32 bits; it never rounds up to 1.
constexpr double uniform_32(std::uint32_t bits) { return bits * 0x1p-32; }

/// A uniform number in [0, 1) with 53 bits.  (By way of signed integers, which processors convert at once.)
constexpr double uniform_53(std::uint32_t high, std::uint32_t low) {
  return static_cast<double>((std::int64_t{high} << 21) ^ (low >> 11)) * 0x1p-53;
}

/// The seed of one purpose ("visibility", "pixels"), so that two rooms never share a number by accident.
std::uint64_t derived_seed(std::uint64_t seed, std::string_view purpose);

/// The key of what numbers serve, from the bits of what tells it from others: equal numbers, equal keys (0 and -0 are
/// equal).
std::uint64_t key_of(std::initializer_list<double> numbers);

/// The numbers of one sample, dimension after dimension, 53 bits each.
class RandomNumbers {
 public:
  constexpr RandomNumbers(std::uint64_t seed, std::uint32_t stream, std::uint64_t index)
      : seed_(seed), index_(index), stream_(stream) {}
  /// The same, but for the first ones, which are given: those of a sample sequence.
  /// @param given  an even number of them, that outlive it
  constexpr RandomNumbers(std::uint64_t seed, std::uint32_t stream, std::uint64_t index, std::span<const double> given)
      : given_(given), seed_(seed), index_(index), stream_(stream) {}

  /// Uniform in [0, 1).
  constexpr double next() {
    if (used_ == 2) fill();
    return pair_[static_cast<std::size_t>(used_++)];
  }
  /// Continue at dimension 2 * block: a decision owns its dimensions, whatever earlier ones consumed.
  constexpr void jump(std::uint32_t block) {
    next_block_ = block;
    used_ = 2;
  }

 private:
  constexpr void fill() {
    const std::uint32_t block = next_block_++;
    used_ = 0;
    if (const std::size_t at = 2 * std::size_t{block}; at < given_.size()) {
      pair_ = {given_[at], given_[at + 1]};
    } else {
      const RandomBlock bits = random_block(seed_, stream_, index_, block);
      pair_ = {uniform_53(bits[0], bits[1]), uniform_53(bits[2], bits[3])};
    }
  }

  std::span<const double> given_;
  std::uint64_t seed_, index_;
  std::uint32_t stream_;
  std::uint32_t next_block_ = 0;
  std::array<double, 2> pair_{};
  int used_ = 2;
};

/// Of RandomNumbers(seed, stream, index) of every index the numbers first .. first + count - 1, sample after sample.
/// Several times sooner than one by one, since samples share each instruction.
/// @param u  overwritten; count a sample
void random_numbers(std::uint64_t seed, std::uint32_t stream, std::span<const std::uint64_t> indices, std::size_t first,
                    std::size_t count, std::span<double> u);
/// The same of samples first, first + 1, .. of a stream, from number 0 on.
/// @param u  overwritten; dimensions a sample
void random_numbers(std::uint64_t seed, std::uint32_t stream, std::uint64_t first, std::size_t dimensions,
                    std::span<double> u);

}  // namespace interflect::core

#pragma once

#include <cstdint>

/// Owen's nested uniform scrambling of words, as fractions of 2^32: bit b (0: the leading one) flips by a coin that is
/// thrown for each value of the bits before it,
///
///   y_b = x_b ^ coin(x_0 .. x_(b-1))
///
/// Words that agree in just their first r bits still do, and all bits after those of both are uniform and independent:
/// nets stay nets, each point is uniform, and means over (0, m, s)-nets of smooth functions have the standard error
/// O(n^-3/2 (log n)^((s-1)/2)).
/// Source: [Owen 1995], [Owen 1997] "Scrambled net variance for integrals of smooth functions".
/// Test: tests/core/sequence/owen.cpp
namespace interflect::core {

/// Each coin by a number of its own: `random_block(seed, dimension, (b, x_0 .. x_(b-1)))`.  32 of them a word; what
/// `owen_scrambled` is held against.
std::uint32_t owen_scrambled_exactly(std::uint32_t word, std::uint64_t seed, std::uint32_t dimension);

/// Two uniform words.
struct ScrambleKey {
  std::uint32_t plus, times;
};

constexpr std::uint32_t reversed_bits(std::uint32_t x) {
  x = x >> 16 | x << 16;
  x = (x >> 8 & 0x00FF00FFu) | (x & 0x00FF00FFu) << 8;
  x = (x >> 4 & 0x0F0F0F0Fu) | (x & 0x0F0F0F0Fu) << 4;
  x = (x >> 2 & 0x33333333u) | (x & 0x33333333u) << 2;
  return (x >> 1 & 0x55555555u) | (x & 0x55555555u) << 1;
}

/// All bits at once, by a hash in which a bit depends on lower ones alone, of the word with its bits reversed: sums,
/// products by odd numbers, and XORs with products by even ones carry upwards only [Laine, Karras 2011].
///
/// Coins are a function of 63 random bits, so not all independent; the pairs of words that variances depend on look as
/// if they were.  The constants are those of [Vegdahl 2021] "Building a better LK hash", since those published first
/// fail that; the factor has a word of its own here, where it was the upper half of the summand.
/// Source: [Burley 2020] "Practical hash-based Owen scrambling", JCGT 9(4).
constexpr std::uint32_t owen_scrambled(std::uint32_t word, ScrambleKey key) {
  std::uint32_t x = reversed_bits(word);
  x ^= x * 0x3D20ADEAu;
  x += key.plus;
  x *= key.times | 1u;
  x ^= x * 0x05526C56u;
  x ^= x * 0x53A22864u;
  return reversed_bits(x);
}

}  // namespace interflect::core

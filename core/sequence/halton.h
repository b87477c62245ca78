#pragma once

#include "core/sample_sequence.h"

namespace interflect::core {

/// The digits of k in a base, mirrored at the point:
///
///   k = a_0 + a_1 b + a_2 b² + ..   ->   a_0 / b + a_1 / b² + .. + a_(D-1) / b^D,   D the least with b^D >= 2^32
///
/// @param base  2 .. 500
/// @return      in [0, 1): at most 1 - b^-D, since digits are summed as an integer
/// Source: [Halton 1960]; base 2 is van der Corput's.  Test: tests/core/sequence/halton.cpp
double radical_inverse(std::uint32_t base, std::uint64_t k);

/// The same with its digits scrambled in Owen's way: digit i by a permutation of 0 .. b - 1 that is a function of `key`
/// and of all digits before it, and what comes after the last digit uniform.
///
///   a_i  ->  (m a_i + s) mod b,    m uniform in 1 .. b - 1, s in 0 .. b - 1, both by a hash of (key, a_0 .. a_(i-1))
///
/// Permutations of this form alone send two different digits to any two different ones equally often, as all
/// permutations would, which is all that variances of means depend on.  Each number is uniform over keys; any b^m
/// points that follow each other from a multiple of b^m have one number in each interval of length b^-m, and the variance of
/// the mean of x over them is 1 / (12 n³).
/// @param base  a prime up to 500
/// @return      in [0, 1)
/// Source: [Owen 1995] "Randomly permuted (t,m,s)-nets and (t,s)-sequences"; linear permutations [Matousek 1998].
double scrambled_radical_inverse(std::uint32_t base, std::uint64_t k, std::uint64_t key);

/// Radical inverses of k in the first 64 primes, scrambled, each by a key of its own; independent numbers beyond.
///
/// Any number of points is evenly spread, not powers of two alone, most of all in the first dimensions; points of two
/// late ones (47, 53) are nearly on a line for the first b of them, unscrambled.  Dearer than Sobol's: a hash a digit.
/// Source: [Halton 1960].  Test: tests/core/sequence/halton.cpp
class HaltonSequence final : public SampleSequence {
 public:
  static constexpr std::size_t dimensions = 64;
  static std::uint32_t base(std::size_t dimension);  ///< 2, 3, 5, ..

  explicit HaltonSequence(std::uint64_t seed) : seed_(seed) {}
  void numbers(std::uint64_t k, std::size_t first, std::span<double> u) const override;
  std::unique_ptr<SampleSequence> replicate(std::uint64_t number) const override;

 private:
  std::uint64_t seed_;
};

}  // namespace interflect::core

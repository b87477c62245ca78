#pragma once

#include "core/sample_sequence.h"

namespace interflect::core {

/// Sobol's first dimensions, scrambled by Owen (sequence/owen.h), again and again for as many dimensions as are asked:
///
///   numbers size g .. size g + size - 1 of point k:   owen_gd(sobol_d(shuffle_g(k))),   d = 0 .. size - 1
///
/// each group g with scrambles of its own and, so that groups know nothing of each other, a shuffle of its own: Owen's
/// scramble of k as a word, the highest bit first, which sends aligned blocks of 2^m points to such blocks.  So in each
/// group every aligned block of 2^m points is a scrambled net: one in each interval of length 2^-m of each dimension,
/// and of the group's first two dimensions one in each rectangle 2^-a x 2^-(m-a).  Every 2^32 points are anew.
///
/// Variances over a block of n points: d / (12 n³) of the mean of x_1 + .. + x_d; nearly n^-3 of what is smooth and in
/// one group; 1 / n of what is a product over groups, a little more than by independent points since both halves of a
/// block swap together: 49/31 times 1 / (144 n) of (x - 1/2)(y - 1/2).  Take 2^m points from a multiple of 2^m.
///
/// Source: [Burley 2020] "Practical hash-based Owen scrambling", JCGT 9(4), for the padding; (0, 2)-sequences
/// for pixels [Kollig, Keller 2002].  Test: tests/core/sequence/padded_sobol.cpp
template <std::size_t size>
class PaddedSobol final : public SampleSequence {
 public:
  explicit PaddedSobol(std::uint64_t seed) : seed_(seed) {}
  void numbers(std::uint64_t k, std::size_t first, std::span<double> u) const override;
  void points(std::uint64_t first, std::size_t dimensions, std::span<double> u) const override;
  void points_of(std::span<const std::uint64_t> which, std::size_t dimensions, std::span<double> u) const override;
  std::unique_ptr<SampleSequence> replicate(std::uint64_t number) const override;

 private:
  std::uint64_t seed_;
};

using SobolOwen = PaddedSobol<4>;
using ZeroTwo = PaddedSobol<2>;
extern template class PaddedSobol<4>;
extern template class PaddedSobol<2>;

}  // namespace interflect::core

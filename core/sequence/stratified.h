#pragma once

#include "core/sample_sequence.h"

namespace interflect::core {

/// Jittered points: of each aligned block of n = m² = 4 096, in each pair of dimensions (2 j, 2 j + 1) one in each of
/// m x m equal squares:
///
///   c = p_j(k mod n),   u_2j = (c mod m + xi) / m,   u_2j+1 = (floor(c / m) + xi') / m
///
/// with p_j a permutation by block and pair, xi and xi' uniform in [0, 1).  Over a block the mean of x + y of a pair
/// has the variance 1 / (6 n²), independent points' is 1 / (6 n), and that of (x - 1/2)(y - 1/2) is (v / 6 - v²) / n with
/// v = 1 / (12 n), independent points' 1 / (144 n).  Pairs know nothing of each other, and parts of a block are as
/// independent points.
/// Source: [Mitchell 1996] "Consequences of stratified sampling in graphics", SIGGRAPH 96, for the rate; shuffled pairs
/// [Cook 1986].  Test: tests/core/sequence/stratified.cpp
class StratifiedSequence final : public SampleSequence {
 public:
  explicit StratifiedSequence(std::uint64_t seed) : seed_(seed) {}
  void numbers(std::uint64_t k, std::size_t first, std::span<double> u) const override;
  std::unique_ptr<SampleSequence> replicate(std::uint64_t number) const override;

 private:
  std::uint64_t seed_;
};

}  // namespace interflect::core

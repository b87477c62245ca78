#pragma once

#include "core/sample_sequence.h"

namespace interflect::core {

/// Of each aligned block of n = 4 096 points, in each dimension one in each of n equal intervals:
///
///   u_d = (p_d(k mod n) + xi_d) / n        (p_d: a permutation by block and dimension, xi_d: uniform in [0, 1))
///
/// The mean of x_1 + .. + x_d over a block has the variance d / (12 n³), independent points' is d / (12 n); what is no
/// sum of functions of one dimension, as (x - 1/2)(y - 1/2), gains nothing.  Parts of a block are as independent
/// points.
/// Source: [McKay, Beckman, Conover 1979]; the variance [Stein 1987].  Test: tests/core/sequence/stratified.cpp
class LatinHypercube final : public SampleSequence {
 public:
  explicit LatinHypercube(std::uint64_t seed) : seed_(seed) {}
  void numbers(std::uint64_t k, std::size_t first, std::span<double> u) const override;
  std::unique_ptr<SampleSequence> replicate(std::uint64_t number) const override;

 private:
  std::uint64_t seed_;
};

}  // namespace interflect::core

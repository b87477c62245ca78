#pragma once

#include "core/sample_sequence.h"

namespace interflect::core {

/// Number d of point k of core/random.h's stream 0.
void independent_numbers(std::uint64_t seed, std::uint64_t k, std::size_t first, std::span<double> u);

/// Every number by itself: means of n points have the variance s² / n.
/// Test: tests/core/sample_sequence.cpp
class IndependentSequence final : public SampleSequence {
 public:
  explicit IndependentSequence(std::uint64_t seed) : seed_(seed) {}
  void numbers(std::uint64_t k, std::size_t first, std::span<double> u) const override;
  void points(std::uint64_t first, std::size_t dimensions, std::span<double> u) const override;
  void points_of(std::span<const std::uint64_t> which, std::size_t dimensions, std::span<double> u) const override;
  std::unique_ptr<SampleSequence> replicate(std::uint64_t number) const override;

 private:
  std::uint64_t seed_;
};

}  // namespace interflect::core

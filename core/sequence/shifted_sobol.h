#pragma once

#include <array>

#include "core/random.h"
#include "core/sample_sequence.h"
#include "core/sobol.h"

namespace interflect::core {

/// Sobol's points (core/sobol.h) with a random linear scramble and a digital shift, in the first eight dimensions, of
/// 2^32 points, which then repeat; independent numbers beyond.
/// Test: tests/core/sobol.cpp, tests/core/sample_sequence.cpp
class ShiftedSobol final : public SampleSequence {
 public:
  explicit ShiftedSobol(std::uint64_t seed);
  void numbers(std::uint64_t k, std::size_t first, std::span<double> u) const override;
  std::unique_ptr<SampleSequence> replicate(std::uint64_t number) const override;

 private:
  std::uint64_t seed_;
  Sobol sobol_;
  std::array<RandomBlock, 2> shift_;
};

}  // namespace interflect::core

#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace interflect::core {

/// Numbers for samples: point k is a function of (seed, k), for any thread in any order.
///
///   independent   every number by itself
///   stratified    of 4 096 samples that follow each other, in each dimension one in each 1/4 096 (a Latin hypercube)
///   sobol         Sobol's points, scrambled and shifted at random (sobol.h), in the first eight dimensions;
///                 independent beyond
///
/// Each point is uniform by itself, whatever the sequence, so that means are unbiased; only independent ones have
/// errors that can be told from one sequence.  Of the others several independent replications say how large errors are.
/// Test: tests/core/sample_sequence.cpp
class SampleSequence {
 public:
  virtual ~SampleSequence() = default;
  /// @param u  overwritten by numbers in [0, 1)
  virtual void point(std::uint64_t k, std::span<double> u) const = 0;
  /// Points from `first` on, one after the other, each of so many dimensions: the same numbers, where it can be sooner.
  /// @param u  overwritten; as long as some points
  virtual void points(std::uint64_t first, std::size_t dimensions, std::span<double> u) const;
  /// The same of points that need not follow each other.
  virtual void points_of(std::span<const std::uint64_t> which, std::size_t dimensions, std::span<double> u) const;
  /// One of the same kind, independent of this one and of all with another number.
  virtual std::unique_ptr<SampleSequence> replicate(std::uint64_t number) const = 0;
};

/// @throws core::InputError  with the names known
std::unique_ptr<SampleSequence> make_sequence(const std::string& name, std::uint64_t seed);
std::vector<std::string> sequence_names();

}  // namespace interflect::core

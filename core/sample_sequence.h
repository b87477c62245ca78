#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace interflect::core {

/// Numbers for samples: number d of point k is a function of (seed, k, d), for any thread in any order, whatever other
/// numbers are asked for.
///
///   independent       every number by itself                                           (sequence/independent.h)
///   stratified        in each pair of dimensions 4 096 points in as many squares       (sequence/stratified.h)
///   latin-hypercube   in each dimension 4 096 points in as many intervals              (sequence/latin_hypercube.h)
///   halton            radical inverses in prime bases, digits scrambled                (sequence/halton.h)
///   sobol             Sobol's points in eight dimensions, a random linear scramble     (sequence/shifted_sobol.h)
///   sobol-owen        four of Sobol's dimensions after the other, scrambled by Owen    (sequence/padded_sobol.h)
///   zero-two          two after the other: a (0, 2)-sequence each                      (sequence/padded_sobol.h)
///
/// Each point is uniform by itself, whatever the sequence, so that means are unbiased; only independent ones have
/// errors that can be told from one sequence.  Of the others several independent replications say how large errors are.
/// docs/sampling.md: which for what.  Tests: tests/core/sample_sequence.cpp, tests/core/sequence/
class SampleSequence {
 public:
  virtual ~SampleSequence() = default;
  /// Numbers first, first + 1, .. of point k.
  /// @param u  overwritten by numbers in [0, 1)
  virtual void numbers(std::uint64_t k, std::size_t first, std::span<double> u) const = 0;
  /// Those from number 0 on.
  void point(std::uint64_t k, std::span<double> u) const { numbers(k, 0, u); }
  /// Points from `first` on, one after the other, each of so many dimensions: the same numbers, where it can be sooner.
  /// @param u  overwritten; as long as some points
  virtual void points(std::uint64_t first, std::size_t dimensions, std::span<double> u) const;
  /// The same of points that need not follow each other.
  virtual void points_of(std::span<const std::uint64_t> which, std::size_t dimensions, std::span<double> u) const;
  /// One of the same kind, independent of this one and of all with another number.  A seed and no more, but of `sobol`,
  /// which scrambles its matrices.
  virtual std::unique_ptr<SampleSequence> replicate(std::uint64_t number) const = 0;

 protected:
  static std::uint64_t seed_of_replication(std::uint64_t seed, std::uint64_t number);
};

/// One that is known by name.
struct SequenceEntry {
  std::string name, summary;
  std::unique_ptr<SampleSequence> (*make)(std::uint64_t seed);
};
const std::vector<SequenceEntry>& known_sequences();
std::vector<std::string> sequence_names();
/// @throws core::InputError  with the names known
std::unique_ptr<SampleSequence> make_sequence(const std::string& name, std::uint64_t seed);

}  // namespace interflect::core

#include "core/sample_sequence.h"

#include "core/error.h"
#include "core/random.h"
#include "core/sequence/halton.h"
#include "core/sequence/independent.h"
#include "core/sequence/latin_hypercube.h"
#include "core/sequence/padded_sobol.h"
#include "core/sequence/shifted_sobol.h"
#include "core/sequence/stratified.h"

namespace interflect::core {
namespace {

template <class Sequence>
std::unique_ptr<SampleSequence> make(std::uint64_t seed) {
  return std::make_unique<Sequence>(seed);
}

}  // namespace

std::uint64_t SampleSequence::seed_of_replication(std::uint64_t seed, std::uint64_t number) {
  return derived_seed(seed, "replication") + 0x9E3779B97F4A7C15u * number;
}

void SampleSequence::points(std::uint64_t first, std::size_t dimensions, std::span<double> u) const {
  for (std::size_t k = 0; (k + 1) * dimensions <= u.size(); ++k)
    point(first + k, u.subspan(k * dimensions, dimensions));
}

void SampleSequence::points_of(std::span<const std::uint64_t> which, std::size_t dimensions,
                               std::span<double> u) const {
  for (std::size_t k = 0; k < which.size(); ++k) point(which[k], u.subspan(k * dimensions, dimensions));
}

const std::vector<SequenceEntry>& known_sequences() {
  static const std::vector<SequenceEntry> all{
      {"independent", "every number by itself", make<IndependentSequence>},
      {"stratified", "4 096 points in 64 x 64 squares, pairs of dimensions by themselves", make<StratifiedSequence>},
      {"latin-hypercube", "4 096 points in as many intervals of each dimension", make<LatinHypercube>},
      {"halton", "radical inverses in 64 prime bases, digits scrambled", make<HaltonSequence>},
      {"sobol", "Sobol's points in eight dimensions, scrambled linearly and shifted", make<ShiftedSobol>},
      {"sobol-owen", "Sobol's points, four dimensions after the other, scrambled by Owen", make<SobolOwen>},
      {"zero-two", "the same, two dimensions after the other: for pixels", make<ZeroTwo>},
  };
  return all;
}

std::vector<std::string> sequence_names() {
  std::vector<std::string> names;
  for (const SequenceEntry& each : known_sequences()) names.push_back(each.name);
  return names;
}

std::unique_ptr<SampleSequence> make_sequence(const std::string& name, std::uint64_t seed) {
  std::string known;
  for (const SequenceEntry& each : known_sequences()) {
    if (each.name == name) return each.make(seed);
    known += (known.empty() ? "" : ", ") + each.name;
  }
  throw InputError("sample sequence '" + name + "'", "one of " + known + " expected");
}

}  // namespace interflect::core

#include "core/sequence/padded_sobol.h"

#include <algorithm>
#include <array>

#include "core/random.h"
#include "core/sequence/owen.h"
#include "core/sobol.h"

namespace interflect::core {
namespace {

/// Sobol's points by four bits of the index at once, shared by all sequences.
template <std::size_t size>
class SobolTable {
 public:
  SobolTable() {
    const Sobol sobol;
    for (std::uint32_t at = 0; at < 8; ++at)
      for (std::uint32_t four = 0; four < 16; ++four) words_[at][four] = sobol.point<size>(four << 4 * at);
  }
  Sobol::Words<size> point(std::uint32_t k) const {
    Sobol::Words<size> x{};
    for (std::size_t at = 0; at < 8; ++at, k >>= 4)
      for (std::size_t d = 0; d < size; ++d) x[d] ^= words_[at][k & 15u][d];
    return x;
  }

 private:
  std::array<std::array<Sobol::Words<size>, 16>, 8> words_;
};

template <std::size_t size>
const SobolTable<size>& sobol_table() {
  static const SobolTable<size> table;
  return table;
}

/// Bits after a scrambled word's: a coin each, as Owen's scramble of infinitely many bits would throw.
constexpr std::uint32_t continued(std::uint32_t word, ScrambleKey key) {
  word = (word ^ key.times) * 0x9E3779B1u;
  word = (word ^ word >> 15) * 0x85EBCA77u + key.plus;
  word = (word ^ word >> 13) * 0xC2B2AE3Du;
  return word ^ word >> 16;
}

/// The numbers of one group of dimensions of 2^32 points.
template <std::size_t size>
class Group {
 public:
  Group(std::uint64_t seed, std::size_t group, std::uint64_t k) : high_(static_cast<std::uint32_t>(k >> 32)) {
    std::array<RandomBlock, (size + 2) / 2> words;
    for (std::uint32_t b = 0; b < words.size(); ++b)
      words[b] = random_block(seed, static_cast<std::uint32_t>(group), high_, b);
    shuffle_ = {words[0][0], words[0][1]};
    for (std::size_t d = 0; d < size; ++d)
      scramble_[d] = {words[(d + 1) / 2][(d + 1) % 2 * 2], words[(d + 1) / 2][(d + 1) % 2 * 2 + 1]};
  }
  bool has(std::uint64_t k) const { return k >> 32 == high_; }
  /// Of those of the group from `within` on.
  void numbers(const SobolTable<size>& sobol, std::uint64_t k, std::size_t within, std::span<double> u) const {
    const Sobol::Words<size> x = sobol.point(owen_scrambled(static_cast<std::uint32_t>(k), shuffle_));
    for (std::size_t i = 0; i < u.size(); ++i) {
      const ScrambleKey& key = scramble_[within + i];
      const std::uint32_t word = owen_scrambled(x[within + i], key);
      u[i] = uniform_53(word, continued(word, key));
    }
  }

 private:
  std::uint32_t high_;
  ScrambleKey shuffle_;
  std::array<ScrambleKey, size> scramble_;
};

/// Points index(0) .. index(n - 1): group after group, whose keys serve all points.
template <std::size_t size, class IndexOf>
void fill(std::uint64_t seed, std::size_t n, const IndexOf& index, std::size_t dimensions, std::span<double> u) {
  if (n == 0) return;
  const SobolTable<size>& sobol = sobol_table<size>();
  for (std::size_t d = 0; d < dimensions; d += size) {
    Group<size> group(seed, d / size, index(0));
    for (std::size_t i = 0; i < n; ++i) {
      const std::uint64_t k = index(i);
      if (!group.has(k)) group = Group<size>(seed, d / size, k);
      group.numbers(sobol, k, 0, u.subspan(i * dimensions + d, std::min(size, dimensions - d)));
    }
  }
}

}  // namespace

template <std::size_t size>
void PaddedSobol<size>::numbers(std::uint64_t k, std::size_t first, std::span<double> u) const {
  const SobolTable<size>& sobol = sobol_table<size>();
  while (!u.empty()) {
    const std::size_t within = first % size, count = std::min(size - within, u.size());
    Group<size>(seed_, first / size, k).numbers(sobol, k, within, u.first(count));
    u = u.subspan(count);
    first += count;
  }
}

template <std::size_t size>
void PaddedSobol<size>::points(std::uint64_t first, std::size_t dimensions, std::span<double> u) const {
  fill<size>(
      seed_, dimensions == 0 ? 0 : u.size() / dimensions, [&](std::size_t i) { return first + i; }, dimensions, u);
}

template <std::size_t size>
void PaddedSobol<size>::points_of(std::span<const std::uint64_t> which, std::size_t dimensions,
                                  std::span<double> u) const {
  fill<size>(
      seed_, which.size(), [&](std::size_t i) { return which[i]; }, dimensions, u);
}

template <std::size_t size>
std::unique_ptr<SampleSequence> PaddedSobol<size>::replicate(std::uint64_t number) const {
  return std::make_unique<PaddedSobol>(seed_of_replication(seed_, number));
}

template class PaddedSobol<4>;
template class PaddedSobol<2>;

}  // namespace interflect::core

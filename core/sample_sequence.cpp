#include "core/sample_sequence.h"

#include <algorithm>

#include "core/error.h"
#include "core/random.h"
#include "core/sobol.h"

namespace interflect::core {
namespace {

std::uint64_t seed_of_replication(std::uint64_t seed, std::uint64_t number) {
  return derived_seed(seed, "replication") + 0x9E3779B97F4A7C15u * number;
}

void fill(RandomNumbers random, std::span<double> u) {
  for (double& number : u) number = random.next();
}

class Independent final : public SampleSequence {
 public:
  explicit Independent(std::uint64_t seed) : seed_(seed) {}
  void point(std::uint64_t k, std::span<double> u) const override { fill({seed_, 0, k}, u); }
  void points(std::uint64_t first, std::size_t dimensions, std::span<double> u) const override {
    random_numbers(seed_, 0, first, dimensions, u);
  }
  void points_of(std::span<const std::uint64_t> which, std::size_t dimensions, std::span<double> u) const override {
    random_numbers(seed_, 0, which, 0, dimensions, u);
  }
  std::unique_ptr<SampleSequence> replicate(std::uint64_t number) const override {
    return std::make_unique<Independent>(seed_of_replication(seed_, number));
  }

 private:
  std::uint64_t seed_;
};

class Stratified final : public SampleSequence {
 public:
  explicit Stratified(std::uint64_t seed) : seed_(seed) {}
  void point(std::uint64_t k, std::span<double> u) const override {
    fill({seed_, 0, k}, u);
    const std::uint64_t block = k >> bits;
    for (std::size_t d = 0; d < u.size(); ++d) {
      const RandomBlock key = random_block(seed_, 1 + static_cast<std::uint32_t>(d), block, 0);
      const std::uint32_t stratum = permuted(static_cast<std::uint32_t>(k) & mask, key);
      u[d] = std::min((stratum + u[d]) / (mask + 1), 0x1.fffffffffffffp-1);
    }
  }
  std::unique_ptr<SampleSequence> replicate(std::uint64_t number) const override {
    return std::make_unique<Stratified>(seed_of_replication(seed_, number));
  }

 private:
  static constexpr std::uint32_t bits = 12, mask = (1u << bits) - 1;

  /// One of many permutations of 0 .. mask: each step, modulo 2^bits, can be undone.
  static std::uint32_t permuted(std::uint32_t k, const RandomBlock& key) {
    for (const std::uint32_t word : key) {
      k = (k + word) & mask;
      k = (k * (2 * (word >> bits) + 1)) & mask;
      k ^= k >> (bits / 2);
      k ^= (word >> (32 - bits)) & mask;
    }
    return k;
  }

  std::uint64_t seed_;
};

class ShiftedSobol final : public SampleSequence {
 public:
  explicit ShiftedSobol(std::uint64_t seed)
      : seed_(seed), sobol_(Sobol::scrambled(seed)), shift_{random_block(seed, 1, 0, 0), random_block(seed, 1, 0, 1)} {}
  void point(std::uint64_t k, std::span<double> u) const override {
    if (u.size() > Sobol::dimensions) fill({seed_, 0, k}, u);
    const auto x = sobol_.point<Sobol::dimensions>(static_cast<std::uint32_t>(k));
    for (std::size_t d = 0; d < std::min<std::size_t>(u.size(), Sobol::dimensions); ++d)
      u[d] = inside_unit(x[d] ^ shift_[d / 4][d % 4]);
  }
  std::unique_ptr<SampleSequence> replicate(std::uint64_t number) const override {
    return std::make_unique<ShiftedSobol>(seed_of_replication(seed_, number));
  }

 private:
  std::uint64_t seed_;
  Sobol sobol_;
  std::array<RandomBlock, 2> shift_;
};

}  // namespace

void SampleSequence::points(std::uint64_t first, std::size_t dimensions, std::span<double> u) const {
  for (std::size_t k = 0; (k + 1) * dimensions <= u.size(); ++k)
    point(first + k, u.subspan(k * dimensions, dimensions));
}

void SampleSequence::points_of(std::span<const std::uint64_t> which, std::size_t dimensions,
                               std::span<double> u) const {
  for (std::size_t k = 0; k < which.size(); ++k) point(which[k], u.subspan(k * dimensions, dimensions));
}

std::vector<std::string> sequence_names() { return {"independent", "stratified", "sobol"}; }

std::unique_ptr<SampleSequence> make_sequence(const std::string& name, std::uint64_t seed) {
  if (name == "independent") return std::make_unique<Independent>(seed);
  if (name == "stratified") return std::make_unique<Stratified>(seed);
  if (name == "sobol") return std::make_unique<ShiftedSobol>(seed);
  throw InputError("sample sequence '" + name + "'", "one of independent, stratified, sobol expected");
}

}  // namespace interflect::core

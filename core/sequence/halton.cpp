#include "core/sequence/halton.h"

#include <array>

#include "core/random.h"
#include "core/sequence/independent.h"

namespace interflect::core {
namespace {

constexpr std::uint64_t least_power = std::uint64_t{1} << 32;  ///< of the base that digits go up to
constexpr std::uint64_t odd = 0x9E3779B97F4A7C15u;             ///< 2^64 over the golden ratio

constexpr std::array<std::uint32_t, HaltonSequence::dimensions> first_primes() {
  std::array<std::uint32_t, HaltonSequence::dimensions> primes{};
  std::size_t found = 0;
  for (std::uint32_t candidate = 2; found < primes.size(); ++candidate) {
    bool prime = true;
    for (std::size_t i = 0; i < found && prime; ++i) prime = candidate % primes[i] != 0;
    if (prime) primes[found++] = candidate;
  }
  return primes;
}
constexpr auto bases = first_primes();
static_assert(bases.back() == 311);

/// A bijection of 64 bits that looks random: the finaliser of [Steele, Lea, Flood 2014] (splitmix64), by Stafford.
constexpr std::uint64_t mixed(std::uint64_t z) {
  z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9u;
  z = (z ^ z >> 27) * 0x94D049BB133111EBu;
  return z ^ z >> 31;
}

/// 0 .. n - 1, each as often but for n 2^-32 of it.
constexpr std::uint32_t below(std::uint32_t n, std::uint32_t random) {
  return static_cast<std::uint32_t>(std::uint64_t{random} * n >> 32);
}

}  // namespace

double radical_inverse(std::uint32_t base, std::uint64_t k) {
  std::uint64_t mirrored = 0, power = 1;
  for (; power < least_power; power *= base, k /= base) mirrored = mirrored * base + k % base;
  return static_cast<double>(mirrored) / static_cast<double>(power);
}

double scrambled_radical_inverse(std::uint32_t base, std::uint64_t k, std::uint64_t key) {
  std::uint64_t mirrored = 0, power = 1, state = key;
  for (; power < least_power; power *= base, k /= base) {
    const auto digit = static_cast<std::uint32_t>(k % base);
    const std::uint64_t random = mixed(state);
    const std::uint32_t times = 1 + below(base - 1, static_cast<std::uint32_t>(random >> 32)),
                        plus = below(base, static_cast<std::uint32_t>(random));
    mirrored = mirrored * base + (times * digit + plus) % base;
    state = random + odd * (digit + 1);
  }
  // 12 bits more are exact, and the quotient stays below 1 when it is rounded.
  static_assert(least_power * 500 < std::uint64_t{1} << (53 - 12));
  const auto after = static_cast<double>(mixed(state + odd * k) >> 52) * 0x1p-12;
  return (static_cast<double>(mirrored) + after) / static_cast<double>(power);
}

std::uint32_t HaltonSequence::base(std::size_t dimension) { return bases.at(dimension); }

void HaltonSequence::numbers(std::uint64_t k, std::size_t first, std::span<double> u) const {
  std::size_t i = 0;
  for (; i < u.size() && first + i < dimensions; ++i) {
    const RandomBlock key = random_block(seed_, 1 + static_cast<std::uint32_t>(first + i), 0, 0);
    u[i] = scrambled_radical_inverse(bases[first + i], k, std::uint64_t{key[0]} << 32 | key[1]);
  }
  if (i < u.size()) independent_numbers(seed_, k, first + i, u.subspan(i));
}

std::unique_ptr<SampleSequence> HaltonSequence::replicate(std::uint64_t number) const {
  return std::make_unique<HaltonSequence>(seed_of_replication(seed_, number));
}

}  // namespace interflect::core

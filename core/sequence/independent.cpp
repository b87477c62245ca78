#include "core/sequence/independent.h"

#include "core/random.h"

namespace interflect::core {

void independent_numbers(std::uint64_t seed, std::uint64_t k, std::size_t first, std::span<double> u) {
  RandomNumbers random(seed, 0, k);
  random.jump(static_cast<std::uint32_t>(first / 2));
  if (first % 2 != 0) random.next();
  for (double& number : u) number = random.next();
}

void IndependentSequence::numbers(std::uint64_t k, std::size_t first, std::span<double> u) const {
  independent_numbers(seed_, k, first, u);
}

void IndependentSequence::points(std::uint64_t first, std::size_t dimensions, std::span<double> u) const {
  random_numbers(seed_, 0, first, dimensions, u);
}

void IndependentSequence::points_of(std::span<const std::uint64_t> which, std::size_t dimensions,
                                    std::span<double> u) const {
  random_numbers(seed_, 0, which, 0, dimensions, u);
}

std::unique_ptr<SampleSequence> IndependentSequence::replicate(std::uint64_t number) const {
  return std::make_unique<IndependentSequence>(seed_of_replication(seed_, number));
}

}  // namespace interflect::core

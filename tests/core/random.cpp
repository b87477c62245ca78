#include "core/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace interflect::core {
namespace {

// Published known answers of Philox4x32-10 (Salmon 2011, the Random123 library's test vectors).
TEST(Random, philox_gives_the_published_known_answers) {
  EXPECT_EQ(philox({0, 0, 0, 0}, 0), (RandomBlock{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  EXPECT_EQ(philox({~0u, ~0u, ~0u, ~0u}, ~0ull), (RandomBlock{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, 0x299f31d0a4093822ull),
            (RandomBlock{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(Random, a_block_is_keyed_by_seed_stream_index_and_block) {
  EXPECT_EQ(random_block(42, 3, 7, 0), (RandomBlock{0x659ef2d0, 0xb60225b4, 0x14334a91, 0x99097b19}));
  EXPECT_EQ(random_block(42, 3, 0x500000007ull, 2), philox({7, 5, 3, 2}, 42));
}

TEST(Random, a_uniform_number_is_never_one) {
  EXPECT_LT(uniform_32(~0u), 1.0);
  EXPECT_LT(uniform_53(~0u, ~0u), 1.0);
  EXPECT_EQ(uniform_53(0, 0), 0.0);
}

// Mean of n uniforms: standard deviation sqrt(1/(12 n)); second moment 1/3 with sqrt(4/45/n).  Two two-sided tests,
// alpha 1e-6 each: 4.9 standard deviations.
TEST(Random, numbers_have_the_moments_of_the_uniform_distribution) {
  constexpr int n = 1'000'000;
  double sum = 0, squares = 0;
  for (int i = 0; i < n; ++i) {
    const double u = RandomNumbers(1, 2, static_cast<std::uint64_t>(i)).next();
    sum += u;
    squares += u * u;
  }
  EXPECT_NEAR(sum / n, 0.5, 4.9 * std::sqrt(1.0 / 12 / n));
  EXPECT_NEAR(squares / n, 1.0 / 3, 4.9 * std::sqrt(4.0 / 45 / n));
}

// Chi-squared of (u_0, u_1) on 16 x 16 cells, 255 degrees of freedom: above 367 with probability 5e-6.
TEST(Random, consecutive_dimensions_fill_the_square_evenly) {
  constexpr int n = 256'000, side = 16;
  std::vector<int> cell(side * side);
  for (int i = 0; i < n; ++i) {
    RandomNumbers numbers(7, 0, static_cast<std::uint64_t>(i));
    const int x = static_cast<int>(numbers.next() * side), y = static_cast<int>(numbers.next() * side);
    ++cell[static_cast<std::size_t>(y) * side + static_cast<std::size_t>(x)];
  }
  double chi2 = 0;
  for (int c : cell) chi2 += (c - 1000.0) * (c - 1000.0) / 1000.0;
  EXPECT_LT(chi2, 367);
  EXPECT_GT(chi2, 165);  // too even would be wrong as well
}

TEST(Random, jumping_reaches_the_same_numbers_as_drawing) {
  RandomNumbers drawn(5, 6, 7), jumped(5, 6, 7);
  for (int i = 0; i < 6; ++i) drawn.next();
  jumped.jump(3);
  EXPECT_EQ(drawn.next(), jumped.next());
}

// Any number of samples, of dimensions, and indices past 2^32, which are carried into the counter's next word.
TEST(Random, numbers_of_many_samples_are_those_of_each) {
  for (const std::size_t dimensions : {1u, 2u, 5u, 8u})
    for (const std::size_t samples : {0u, 1u, 31u, 32u, 100u}) {
      const std::uint64_t first = 0xFFFFFFFFull - 40;
      std::vector<double> u(samples * dimensions);
      random_numbers(9, 3, first, dimensions, u);
      for (std::size_t k = 0; k < samples; ++k) {
        RandomNumbers one(9, 3, first + k);
        for (std::size_t d = 0; d < dimensions; ++d) ASSERT_EQ(u[k * dimensions + d], one.next()) << k << ' ' << d;
      }
    }
}

TEST(Random, blocks_at_once_are_those_of_each) {
  for (const std::uint64_t index : {std::uint64_t{0}, std::uint64_t{5} << 32 | 7})
    for (const std::uint32_t first : {0u, 3u, 0xFFFFFFF0u}) {
      const RandomBlocks many = random_blocks(11, 9, index, first);
      for (std::uint32_t b = 0; b < blocks_at_once; ++b)
        for (std::size_t w = 0; w < 4; ++w) EXPECT_EQ(many[w][b], random_block(11, 9, index, first + b)[w]);
    }
}

TEST(Random, numbers_of_some_samples_from_any_on_are_those_of_each) {
  std::vector<std::uint64_t> indices;
  for (std::uint64_t k = 0; k < 45; ++k) indices.push_back(k * k * k << 20 | k);
  for (const std::size_t first : {0u, 1u, 2u, 7u})
    for (const std::size_t count : {1u, 2u, 5u}) {
      std::vector<double> u(indices.size() * count);
      random_numbers(~std::uint64_t{3}, 0x80000001u, indices, first, count, u);
      for (std::size_t k = 0; k < indices.size(); ++k) {
        RandomNumbers one(~std::uint64_t{3}, 0x80000001u, indices[k]);
        for (std::size_t d = 0; d < first; ++d) one.next();
        for (std::size_t d = 0; d < count; ++d)
          ASSERT_EQ(u[k * count + d], one.next()) << first << ' ' << k << ' ' << d;
      }
    }
}

TEST(Random, purposes_have_seeds_of_their_own) {
  EXPECT_NE(derived_seed(1, "visibility"), derived_seed(1, "pixels"));
  EXPECT_NE(derived_seed(1, "visibility"), derived_seed(2, "visibility"));
  EXPECT_EQ(derived_seed(1, "visibility"), derived_seed(1, "visibility"));
}

}  // namespace
}  // namespace interflect::core

#include "montecarlo/waves.h"

#include <gtest/gtest.h>

namespace interflect::montecarlo {
namespace {

// What is kept at once must not grow with the number of measurements: one round of these has 100 000 blocks.
TEST(Waves, are_never_longer_than_their_limit) {
  const std::vector<std::uint64_t> counts(100'000, 300);
  Waves waves(counts);
  std::size_t blocks = 0;
  for (auto wave = waves.next(); !wave.empty(); wave = waves.next()) {
    ASSERT_LE(wave.size(), Waves::blocks_per_wave);
    blocks += wave.size();
  }
  EXPECT_EQ(blocks, 200'000u);
}

TEST(Waves, give_every_sample_once_in_order_and_advance_all_measurements_together) {
  const std::vector<std::uint64_t> counts{1, 0, 256, 257, 5'000'000, 1000};
  std::vector<std::uint64_t> given(counts.size());
  Waves waves(counts);
  std::uint64_t round = 0;
  for (auto wave = waves.next(); !wave.empty(); wave = waves.next())
    for (const SampleBlock& block : wave) {
      ASSERT_EQ(block.first, given[block.measurement]);
      ASSERT_GT(block.end, block.first);
      ASSERT_LE(block.end - block.first, Waves::samples_per_block);
      ASSERT_GE(block.first, round);  // no round begins before the last has ended
      round = block.first;
      given[block.measurement] = block.end;
    }
  EXPECT_EQ(given, counts);
}

TEST(Waves, of_nothing_are_none) {
  EXPECT_TRUE(Waves({}).next().empty());
  const std::vector<std::uint64_t> counts(3, 0);
  EXPECT_TRUE(Waves(counts).next().empty());
}

}  // namespace
}  // namespace interflect::montecarlo

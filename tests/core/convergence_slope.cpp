#include "core/convergence_slope.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "core/random.h"

namespace interflect::core {
namespace {

const std::vector<std::uint64_t> samples{16, 32, 64, 128, 256, 512};

TEST(ConvergenceSlope, of_a_power_of_n_is_that_power_and_exact) {
  std::vector<std::vector<double>> means(8, std::vector<double>(samples.size()));
  for (std::size_t r = 0; r < means.size(); ++r)
    for (std::size_t k = 0; k < samples.size(); ++k)
      means[r][k] = 3 + (static_cast<double>(r) - 2) * std::pow(static_cast<double>(samples[k]), -1.25);
  const ConvergenceSlope found = convergence_slope(samples, means);
  EXPECT_NEAR(found.slope, -1.25, 1e-12);
  EXPECT_NEAR(found.standard_error, 0, 1e-12);
  EXPECT_NEAR(found.rmse[0], std::pow(16, -1.25) * std::sqrt(6.), 1e-12);  // of 0 .. 7: variance 6
  EXPECT_EQ(found.degrees_of_freedom, 7);
}

// Of independent numbers the slope is -1/2.  95 % intervals that hold it in 95 % of 400 runs do so in 364 .. 393 of them
// but for a probability of 5e-4 (binomial).
TEST(ConvergenceSlope, s_interval_holds_the_truth_as_often_as_it_says) {
  constexpr int runs = 400;
  int held = 0;
  for (std::uint32_t run = 0; run < runs; ++run) {
    std::vector<std::vector<double>> means(32);
    for (std::size_t r = 0; r < means.size(); ++r) {
      double sum = 0;
      std::uint64_t n = 0;
      for (const std::uint64_t end : samples) {
        for (; n < end; ++n) sum += RandomNumbers(r, run, n).next();
        means[r].push_back(sum / static_cast<double>(end));
      }
    }
    const ConvergenceSlope found = convergence_slope(samples, means);
    held += std::abs(found.slope + 0.5) <= found.half_width();
  }
  EXPECT_GE(held, 364);
  EXPECT_LE(held, 393);
}

TEST(ConvergenceSlope, asks_for_enough_to_tell) {
  const std::vector<std::vector<double>> two(2, {1, 2}), three(3, {1, 2});
  EXPECT_THROW(convergence_slope(std::vector<std::uint64_t>{1, 2}, two), PreconditionError);
  EXPECT_THROW(convergence_slope(std::vector<std::uint64_t>{1}, three), PreconditionError);
}

}  // namespace
}  // namespace interflect::core

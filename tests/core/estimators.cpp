#include <gtest/gtest.h>

#include <cmath>

#include "core/batch_means.h"
#include "core/control_variate.h"
#include "core/random.h"
#include "core/student_t.h"

namespace interflect::core {
namespace {

TEST(BatchMeans, know_how_wrong_they_are_whatever_is_correlated_within) {
  // Samples in runs of 50 that are equal: the naive standard error would be seven times too small.
  constexpr int runs = 400, batches = 32, samples = 3200;
  int held = 0;
  for (int run = 0; run < runs; ++run) {
    BatchMeans means(batches);
    for (int k = 0; k < samples; ++k) {
      RandomNumbers numbers(3, static_cast<std::uint32_t>(run), static_cast<std::uint64_t>(k / 50));
      means.add(k * batches / samples, numbers.next());
    }
    held += std::abs(means.mean() - .5) <= means.half_width();
  }
  // Binomial of .95: [366, 393] of 400 leave 1e-3.
  EXPECT_GE(held, 366);
  EXPECT_LE(held, 393);
}

TEST(BatchMeans, use_students_distribution) {
  BatchMeans means(8);
  for (int k = 0; k < 8; ++k) means.add(k, k % 2);
  EXPECT_NEAR(means.half_width(), 2.364624 * means.standard_error(), 1e-6);
  EXPECT_NEAR(means.mean(), .5, 1e-15);
  EXPECT_NEAR(student_t(.95, 15), 2.131450, 1e-6);
  EXPECT_NEAR(student_t(.95, 31), 2.039513, 1e-6);
  EXPECT_NEAR(student_t(.95, 63), 1.998341, 1e-6);
}

// e^x with g = x, G = 1/2: Var(f) - Cov(f, g)² / Var(g) is left, Cov = 1 - (e - 1) / 2, Var(g) = 1/12.
TEST(ControlVariate, leaves_what_is_not_correlated) {
  const double e = std::exp(1.0), variance = (e * e - 1) / 2 - (e - 1) * (e - 1), covariance = 1 - (e - 1) / 2,
               left = variance - covariance * covariance * 12;
  ScalarMoments means;
  constexpr int n = 2048;
  for (int run = 0; run < 400; ++run) {
    ControlVariate help(.5, 16);
    for (int k = 0; k < n; ++k) {
      RandomNumbers numbers(5, static_cast<std::uint32_t>(run), static_cast<std::uint64_t>(k));
      const double x = numbers.next();
      help.add(std::exp(x), x);
    }
    means.add(help.result().mean);
  }
  EXPECT_LT(left, .02 * variance);
  // A variance by 400 runs has the relative standard error sqrt(2 / 399) = .071: within four of them.
  EXPECT_NEAR(means.variance() * n / left, 1, .3);
  EXPECT_NEAR(means.mean(), e - 1, 4 * means.standard_error());
}

// Few samples are where a factor from the same samples shows: its mean is off by far more than these 1e5 runs' error.
TEST(ControlVariate, is_unbiased_by_eight_samples) {
  ScalarMoments fitted, naive;
  for (std::uint64_t run = 0; run < 100'000; ++run) {
    ControlVariate help(.5, 8);
    RandomNumbers numbers(6, 0, run);
    double f[8], g[8], mean_f = 0, mean_g = 0, fg = 0, gg = 0;
    for (int k = 0; k < 8; ++k) {
      g[k] = numbers.next();
      f[k] = g[k] * g[k] * g[k] * g[k];
      help.add(f[k], g[k]);
      mean_f += f[k] / 8, mean_g += g[k] / 8;
    }
    for (int k = 0; k < 8; ++k) fg += (f[k] - mean_f) * (g[k] - mean_g), gg += (g[k] - mean_g) * (g[k] - mean_g);
    fitted.add(help.result().mean);
    naive.add(mean_f - fg / gg * (mean_g - .5));
  }
  EXPECT_NEAR(fitted.mean(), .2, 4 * fitted.standard_error());
  EXPECT_GT(std::abs(naive.mean() - .2), 10 * naive.standard_error());  // so this would be seen
}

TEST(ControlVariate, of_nothing_and_of_what_does_not_vary) {
  EXPECT_TRUE(std::isinf(ControlVariate(0, 3).result().standard_error));
  ControlVariate same(2, 4);
  for (int k = 0; k < 40; ++k) same.add(k % 5, 2);
  EXPECT_NEAR(same.result().mean, 2, 1e-12);
}

}  // namespace
}  // namespace interflect::core

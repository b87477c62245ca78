#include "validation/statistics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"

using namespace interflect;
using namespace interflect::validation;

TEST(Statistics, the_normal_distribution_has_its_tabulated_values) {
  // Abramowitz and Stegun, table 26.1 and 26.2.
  EXPECT_NEAR(normal_cdf(1.0), 0.841344746068543, 1e-15);
  EXPECT_NEAR(normal_cdf(-2.0), 0.022750131948179, 1e-15);
  EXPECT_NEAR(normal_cdf(-6.0) / 9.86587645037698e-10, 1, 1e-13);
  EXPECT_NEAR(normal_quantile(0.975), 1.959963984540054, 1e-14);
  EXPECT_NEAR(normal_upper_quantile(0.005), 2.575829303548901, 1e-14);
  EXPECT_NEAR(normal_quantile(0.5), 0, 1e-15);
}

TEST(Statistics, the_normal_quantile_inverts_the_distribution_in_both_tails) {
  for (double q : {1e-300, 1e-100, 1e-12, 1e-6, 0.01, 0.3, 0.5, 0.7, 0.99, 1 - 1e-9}) {
    const double x = normal_upper_quantile(q);
    EXPECT_NEAR(normal_cdf(-x) / q, 1, 1e-12) << q;
    EXPECT_EQ(normal_quantile(q), -x) << q;
  }
}

TEST(Statistics, probabilities_outside_the_unit_interval_are_refused) {
  for (double p : {0.0, 1.0, -0.1, 2.0, std::nan("")}) {
    EXPECT_THROW(normal_quantile(p), core::PreconditionError);
    EXPECT_THROW(sidak_level(p, 3), core::PreconditionError);
  }
}

TEST(Statistics, sidaks_limit_has_its_tabulated_values) {
  EXPECT_NEAR(sidak_z_max(0.01, 100), 3.8894, 5e-5);
  EXPECT_NEAR(sidak_z_max(0.01, 1000), 4.4161, 5e-5);
  EXPECT_NEAR(sidak_z_max(0.01, 10000), 4.8907, 5e-5);
  EXPECT_NEAR(sidak_z_max(0.01, 262144), 5.4983, 5e-5);
  EXPECT_NEAR(std::pow(1 - sidak_level(0.01, 500), 500), 0.99, 1e-12);
}

TEST(Statistics, the_quantile_of_a_sum_of_squares_is_that_of_chi_square) {
  // chi²_0.95 with 1, 10, 100 degrees: 3.841459, 18.30704, 124.3421; mean nu, variance 2 nu.  The cube root is within 3
  // %.
  EXPECT_NEAR(sum_of_squares_quantile(1, 2, 0.95) / 3.841459, 1, 0.03);
  EXPECT_NEAR(sum_of_squares_quantile(10, 20, 0.95) / 18.30704, 1, 1e-3);
  EXPECT_NEAR(sum_of_squares_quantile(100, 200, 0.95) / 124.3421, 1, 1e-4);
  EXPECT_EQ(sum_of_squares_quantile(0, 0, 0.95), 0);
}

#include "validation/comparison.h"

#include <gtest/gtest.h>

#include <limits>

#include "synthetic.h"

using namespace interflect;
using namespace interflect::validation;

namespace {

Judged one(double fem, double mc, double se_fem, double se_mc, double bound) {
  Judged j;
  j.fem = {Spectrum(fem), Spectrum(se_fem), Spectrum(bound), Claim::estimated, 1};
  j.mc = unbiased_estimate(Spectrum(mc), Spectrum(se_mc), 1);
  return j;
}

}  // namespace

TEST(Comparison, agreement_is_bound_plus_three_combined_standard_errors) {
  // SE = hypot(3, 4) = 5, bound 10: |d| <= 25 agrees.
  const Difference in = difference(one(125, 100, 3, 4, 10), synthetic::grey);
  EXPECT_DOUBLE_EQ(in.standard_error, 5);
  EXPECT_DOUBLE_EQ(in.z, 5);
  EXPECT_NEAR(in.excess_z, 3, 1e-9);
  EXPECT_TRUE(in.agrees);
  EXPECT_FALSE(difference(one(125.001, 100, 3, 4, 10), synthetic::grey).agrees);
  const Difference below = difference(one(75, 100, 3, 4, 10), synthetic::grey);
  EXPECT_TRUE(below.agrees);
  EXPECT_NEAR(below.excess_z, -3, 1e-9);
  EXPECT_EQ(difference(one(95, 100, 3, 4, 10), synthetic::grey).excess_z, 0);
}

TEST(Comparison, an_unknown_bound_or_standard_error_never_agrees) {
  const double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  for (const Judged& j : {one(100, 100, 0, 1, inf), one(100, 100, 0, inf, 1), one(100, 100, 0, 1, nan),
                          one(nan, 100, 0, 1, 1), one(100, 100, nan, 1, 1)}) {
    const Difference d = difference(j, synthetic::grey);
    EXPECT_FALSE(d.known);
    EXPECT_FALSE(d.agrees);
  }
}

TEST(Comparison, the_noise_of_a_weighted_value_is_measured_or_bounded_and_says_which) {
  const scene::Scene two = synthetic::scene({"a", "b"});
  const std::vector<Reading> readings = readings_of(two);
  Estimate e = unbiased_estimate(Spectrum(10), Spectrum::zero(), 100);
  e.standard_error[0] = 3, e.standard_error[1] = 1;
  const Noise bounded = readings[0].noise(e);
  EXPECT_DOUBLE_EQ(bounded.standard_error, (3.0 + 1.0) / 2);
  EXPECT_FALSE(bounded.exact);
  e.weighed_standard_error = 1.25;
  const Noise measured = readings[0].noise(e);
  EXPECT_EQ(measured.standard_error, 1.25);
  EXPECT_TRUE(measured.exact);
  EXPECT_EQ(readings[0].noise(scaled(e, -2)).standard_error, 2.5);
  const Noise channel = readings[1].noise(e);  // its own, whatever the weighted value's
  EXPECT_EQ(channel.standard_error, 3);
  EXPECT_TRUE(channel.exact);
  EXPECT_FALSE(readings[1].noise(unbiased_estimate(Spectrum::zero(), Spectrum(1), 100)).exact);  // rule of three
}

TEST(Comparison, two_exact_answers_must_be_equal_up_to_rounding) {
  EXPECT_TRUE(difference(one(0, 0, 0, 0, 0), synthetic::grey).agrees);
  EXPECT_TRUE(difference(one(1 + 1e-15, 1, 0, 0, 0), synthetic::grey).agrees);
  const Difference d = difference(one(1 + 1e-9, 1, 0, 0, 0), synthetic::grey);
  EXPECT_FALSE(d.agrees);
  EXPECT_EQ(d.excess_z, std::numeric_limits<double>::infinity());
}

TEST(Comparison, a_channel_without_weight_counts_nothing_even_if_it_is_infinite) {
  Judged j = one(100, 100, 0, 1, 1);
  for (int c = 1; c < Spectrum::capacity; ++c) j.fem.error_bound[c] = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(difference(j, synthetic::grey).agrees);
}

TEST(Comparison, noise_alone_stays_below_the_limit_in_all_but_alpha_of_the_sets) {
  // 400 sets of 500 at alpha = 0.05: 20 expected beyond for the largest z; binomial, 5 sigma = 22.  The mean's limit is
  // wider.
  const double z_max = sidak_z_max(0.05, 500);
  int beyond = 0, drifting = 0;
  for (std::uint64_t set = 0; set < 400; ++set) {
    const Comparison c = compare(synthetic::judged({}, set), synthetic::grey, z_max);
    beyond += c.beyond_chance.empty() ? 0 : 1;
    drifting += c.drifts() ? 1 : 0;
    EXPECT_GE(c.share, 0.98);  // P(|z| > 3) = 0.0027: more than 10 of 500 have probability 1e-7
  }
  EXPECT_GT(beyond, 4);
  EXPECT_LT(beyond, 42);
  EXPECT_EQ(drifting, 0);
}

TEST(Comparison, a_loss_that_no_single_z_sees_shows_in_their_mean) {
  // 0.2 % of bias at 1 % noise is z = 0.2 each; the mean of 10 000 has standard error 0.01: 20 sigma.
  const synthetic::Plan loss{.count = 10000, .bias = -0.002};
  const double z_max = sidak_z_max(0.01, 10001);
  const Comparison c = compare(synthetic::judged(loss, 3), synthetic::grey, z_max);
  EXPECT_GT(c.share, 0.99);
  EXPECT_TRUE(c.beyond_chance.empty());
  EXPECT_NEAR(c.mean_z, -0.2, 0.05);
  EXPECT_TRUE(c.drifts());
  EXPECT_FALSE(compare(synthetic::judged({.count = 10000}, 3), synthetic::grey, z_max).drifts());
}

// What the mean cannot see, however many measurements there are: Norms::bias tells it.
TEST(Comparison, a_loss_inside_the_error_bounds_is_no_drift) {
  const synthetic::Plan loss{.count = 10000, .bias = -0.002, .bound = 0.003};
  EXPECT_FALSE(compare(synthetic::judged(loss, 3), synthetic::grey, sidak_z_max(0.01, 10001)).drifts());
}

TEST(Comparison, noise_that_fem_shares_between_elements_is_no_drift) {
  // FEM's noise the same everywhere: one number, +1.5 sigma, in all of 500 measurements.
  std::vector<Judged> judged = synthetic::judged({.noise = 0.001, .claimed_noise = 0.001}, 5);
  for (Judged& j : judged) {
    const double H = synthetic::truth(static_cast<int>(j.element));
    j.fem.value += Spectrum(1.5 * 0.01 * H);
    j.fem.standard_error = Spectrum(0.01 * H);
  }
  EXPECT_FALSE(compare(judged, synthetic::grey, sidak_z_max(0.01, 501)).drifts());
}

TEST(Comparison, one_wrong_element_is_found_and_named_first) {
  std::vector<Judged> judged = synthetic::judged({}, 9);
  judged[123].fem.value *= 1.2;  // 20 sigma
  const Comparison c = compare(judged, synthetic::grey, sidak_z_max(0.01, 501));
  ASSERT_EQ(c.beyond_chance.size(), 1u);
  EXPECT_EQ(c.beyond_chance[0], 123u);
  EXPECT_EQ(c.disagreeing[0], 123u);
}

TEST(Comparison, standard_errors_that_are_too_small_or_too_large_show_in_the_spread_of_z) {
  // The mean of z² has standard error sqrt(2/500) = 0.063 in units of its expectation.
  const double z_max = sidak_z_max(0.01, 501);
  const Comparison small = compare(synthetic::judged({.claimed_noise = 0.003}, 2), synthetic::grey, z_max);
  EXPECT_LT(small.share, 0.8);
  EXPECT_FALSE(small.beyond_chance.empty());
  const Comparison large = compare(synthetic::judged({.claimed_noise = 0.02}, 2), synthetic::grey, z_max);
  EXPECT_NEAR(large.mean_z_square, 0.25, 0.25 * 5 * 0.063);
  EXPECT_NEAR(compare(synthetic::judged({}, 2), synthetic::grey, z_max).mean_z_square, 1, 5 * 0.063);
}

#include "visual/scale.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

using namespace interflect::visual;

TEST(Scale, numbers_are_rounded_up_to_round_ones) {
  const std::pair<double, double> known[] = {{0.97, 1},      {1, 1},    {1.01, 1.2}, {437, 500},
                                             {6.1e-7, 8e-7}, {8.5, 10}, {0, 1},      {-3, 1}};
  for (const auto& [x, round] : known) EXPECT_NEAR(round_up(x) / round, 1, 1e-12) << x;
}

TEST(Scale, the_range_ends_above_the_99th_percentile_by_area) {
  const double values[] = {1, 20, 430, 9000}, areas[] = {50, 40, 9.5, 0.5};
  EXPECT_EQ(range_of(values, areas, false).high, 500);
  EXPECT_EQ(range_of(values, areas, false).low, 0);
  const double differences[] = {-3, 1, std::nan("")};
  EXPECT_EQ(range_of(differences, {}, true).low, -3);
  EXPECT_EQ(range_of(differences, {}, true).high, 3);
}

TEST(Scale, ticks_are_round_and_reach_the_ends) {
  EXPECT_EQ(ticks_of({0, 500}), (std::vector<double>{0, 100, 200, 300, 400, 500}));
  EXPECT_EQ(ticks_of({0, 2}).size(), 5u);
  for (double high : {1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0})
    for (double ten : {1e-6, 1.0, 1e5})
      for (double low : {0.0, -high * ten}) {
        const std::vector<double> ticks = ticks_of({low, high * ten});
        EXPECT_NEAR(ticks.front(), low, 1e-9 * high * ten);
        EXPECT_NEAR(ticks.back() / (high * ten), 1, 1e-9);
        EXPECT_GE(ticks.size(), 5u);
        EXPECT_LE(ticks.size(), 13u);
      }
}

TEST(Scale, a_logarithmic_range_spans_what_is_in_view_by_powers_of_ten) {
  const Range range = logarithmic_range(std::vector<double>{0.03, 0.3, 42, 9000, 0, std::nan("")},
                                        std::vector<double>{10, 50, 39.5, 0.5, 100, 10});
  EXPECT_NEAR(range.low / 0.02, 1, 1e-12);
  EXPECT_NEAR(range.high / 50, 1, 1e-12);
  EXPECT_EQ(range.part(range.low), 0);
  EXPECT_EQ(range.part(range.high), 1);
  EXPECT_NEAR(range.part(1), 0.5, 1e-12);  // 1 is the mean of 0.02 and 50
  EXPECT_EQ(range.part(0), 0);
  EXPECT_EQ(range.part(-1), 0);
  EXPECT_TRUE(std::isnan(range.part(std::nan(""))));

  const Range wide = logarithmic_range(std::vector<double>{1e-9, 30}, {});
  EXPECT_NEAR(wide.low / 2e-3, 1, 1e-12);  // four decades below 30, rounded
  const Range nothing = logarithmic_range(std::vector<double>{0, 0}, {});
  EXPECT_GT(nothing.high, nothing.low);
  const Range one = logarithmic_range(std::vector<double>{2, 2}, {});
  EXPECT_GT(one.high, one.low);
}

TEST(Scale, ticks_of_a_logarithmic_range_are_one_two_and_five_times_powers_of_ten) {
  const std::vector<double> known{0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5}, ticks = ticks_of({0.02, 5, true});
  ASSERT_EQ(ticks.size(), known.size());
  for (std::size_t k = 0; k < known.size(); ++k) EXPECT_NEAR(ticks[k] / known[k], 1, 1e-12);
  EXPECT_EQ(ticks_of({1e-12, 1, true}).size(), 13u);  // of many decades the powers alone
}

TEST(Scale, labels_have_the_digits_that_their_steps_need) {
  EXPECT_EQ(tick_label(0, 100), "0");
  EXPECT_EQ(tick_label(500, 100), "500");
  EXPECT_EQ(tick_label(12500, 2500), "12 500");
  EXPECT_EQ(tick_label(-0.25, 0.25), "-0.25");
  EXPECT_EQ(tick_label(0.5, 0.25), "0.5");
  EXPECT_EQ(tick_label(2.5, 2.5), "2.5");
  EXPECT_EQ(tick_label(2e7, 1e7), "2e+07");
  EXPECT_EQ(tick_label(2e-7, 1e-7), "2e-07");
}

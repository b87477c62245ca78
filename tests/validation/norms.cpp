#include "validation/norms.h"

#include <gtest/gtest.h>

#include "synthetic.h"

using namespace interflect;
using namespace interflect::validation;

namespace {

const auto every = [](const Judged&) { return true; };

struct Truth {
  double l1 = 0, l2 = 0;
};

/// Of FEM's values themselves against the true H.
Truth truth_of(const std::vector<Judged>& judged) {
  double d1 = 0, d2 = 0, h1 = 0, h2 = 0;
  for (const Judged& j : judged) {
    const double H = synthetic::truth(static_cast<int>(j.element)), d = j.fem.value[0] - H;
    d1 += j.area * std::abs(d);
    d2 += j.area * d * d;
    h1 += j.area * H;
    h2 += j.area * H * H;
  }
  return {d1 / h1, std::sqrt(d2 / h2)};
}

struct Coverage {
  int l1 = 0, l2 = 0;
  double mean_square = 0, mean_true_square = 0, square_of_square = 0, mean_l1 = 0, mean_true_l1 = 0;
};

Coverage cover(const synthetic::Plan& plan, int sets) {
  Coverage c;
  for (int set = 0; set < sets; ++set) {
    const std::vector<Judged> judged = synthetic::judged(plan, static_cast<std::uint64_t>(set));
    const Truth truth = truth_of(judged);
    const Norms n = error_norms(judged, synthetic::grey, every);
    c.l1 += n.l1.low <= truth.l1 && truth.l1 <= n.l1.high;
    c.l2 += n.l2.low <= truth.l2 && truth.l2 <= n.l2.high;
    const double off = n.l2.value * n.l2.value - truth.l2 * truth.l2;
    c.mean_square += off / sets;
    c.square_of_square += off * off / sets;
    c.mean_true_square += truth.l2 * truth.l2 / sets;
    c.mean_l1 += n.l1.value / sets;
    c.mean_true_l1 += truth.l1 / sets;
  }
  return c;
}

}  // namespace

TEST(Norms, without_noise_they_are_their_definitions) {
  std::vector<Judged> judged = synthetic::judged({.noise = 0, .claimed_noise = 0, .bias = 0.01, .spread = 0.02}, 1);
  const Truth truth = truth_of(judged);
  const Norms n = error_norms(judged, synthetic::grey, every);
  for (const Interval& l2 : {n.l2}) {
    EXPECT_NEAR(l2.value, truth.l2, 1e-14);
    EXPECT_NEAR(l2.low, truth.l2, 1e-14);
    EXPECT_NEAR(l2.high, truth.l2, 1e-14);
  }
  EXPECT_NEAR(n.l1.value, truth.l1, 1e-14);
  EXPECT_EQ(n.reference_error, 0);
}

TEST(Norms, the_maximum_is_relative_to_the_mean_irradiance_and_names_its_place) {
  std::vector<Judged> judged = synthetic::judged({.noise = 0, .claimed_noise = 0}, 1);
  judged[77].fem.value += Spectrum(10);
  const Norms n = error_norms(judged, synthetic::grey, every);
  EXPECT_EQ(n.worst, "element 77");
  EXPECT_NEAR(n.max.value, 10 / n.mean_irradiance, 1e-12);
  EXPECT_NEAR(n.max.low, n.max.high, 1e-12);
}

TEST(Norms, intervals_cover_the_truth_and_l2_is_unbiased_where_noise_is_as_large_as_the_error) {
  // 1 000 sets; coverage 0.95 has sigma 6.9.  The delta method is asymptotic in 500 measurements of unequal areas
  // (effective number about 150): one percent is allowed below, besides 4 sigma: 950 - 10 - 28.  L1's interval is
  // conservative by design.
  const Coverage c = cover({.noise = 0.01, .spread = 0.01}, 1000);
  EXPECT_GE(c.l2, 912);
  EXPECT_LE(c.l2, 985);
  EXPECT_GE(c.l1, 950);
  const double sigma = std::sqrt(c.square_of_square / 1000);
  EXPECT_LT(std::abs(c.mean_square), 4 * sigma);
  EXPECT_GT(c.mean_true_square, 100 * sigma);        // and a missing correction (100 %) would be seen
  EXPECT_NEAR(c.mean_l1 / c.mean_true_l1, 1, 0.01);  // its factor is right for normal errors
}

TEST(Norms, intervals_cover_the_truth_where_the_error_is_a_constant_bias_or_nothing_at_all) {
  const Coverage bias = cover({.noise = 0.01, .bias = 0.02}, 1000);
  EXPECT_GE(bias.l2, 912);
  EXPECT_GE(bias.l1, 950);
  const Coverage none = cover({.noise = 0.01}, 1000);
  EXPECT_GE(none.l2, 912);
  EXPECT_GE(none.l1, 950);
}

TEST(Norms, the_maximums_interval_covers_the_largest_error) {
  int covered = 0;
  for (std::uint64_t set = 0; set < 1000; ++set) {
    const std::vector<Judged> judged = synthetic::judged({.count = 100, .noise = 0.01, .spread = 0.01}, set);
    double largest = 0, light = 0, area = 0;
    for (const Judged& j : judged) {
      const double H = synthetic::truth(static_cast<int>(j.element));
      largest = std::max(largest, std::abs(j.fem.value[0] - H));
      light += j.area * H;
      area += j.area;
    }
    const Norms n = error_norms(judged, synthetic::grey, every);
    const double truth = largest / (light / area);
    covered += n.max.low <= truth * 1.01 && truth * 0.99 <= n.max.high;  // the denominator has noise of its own, 0.1 %
  }
  EXPECT_GE(covered, 950);
}

TEST(Norms, the_references_own_error_is_exceeded_in_one_set_of_twenty) {
  int exceeded = 0;
  for (std::uint64_t set = 0; set < 1000; ++set) {
    const std::vector<Judged> judged = synthetic::judged({.noise = 0.01}, set);
    double d2 = 0, h2 = 0;
    for (const Judged& j : judged) {
      const double H = synthetic::truth(static_cast<int>(j.element));
      d2 += j.area * std::pow(j.mc.value[0] - H, 2);
      h2 += j.area * H * H;
    }
    exceeded += std::sqrt(d2 / h2) > error_norms(judged, synthetic::grey, every).reference_error;
  }
  EXPECT_GE(exceeded, 50 - 28);
  EXPECT_LE(exceeded, 50 + 28);  // 4 sigma
}

TEST(Norms, chosen_elements_stand_for_those_that_were_not) {
  // 5 000 elements whose errors vary inside surfaces; 500 chosen at random, each standing for ten.  The interval must
  // cover the norm of all, though the reference is exact: its width is that of the choice.
  const std::vector<Judged> all = synthetic::judged({.count = 5000, .noise = 0, .claimed_noise = 0, .spread = 0.02}, 4);
  const Truth truth = truth_of(all);
  int covered = 0, covered_l1 = 0;
  for (std::uint64_t set = 0; set < 1000; ++set) {
    std::vector<Judged> chosen;
    core::RandomNumbers random(set, 1, 0);
    for (std::size_t surface = 0; surface < 10; ++surface) {
      double area = 0, chosen_area = 0;
      for (std::size_t i = 0; i < 500; ++i) area += all[500 * surface + i].area;
      const std::size_t first = chosen.size();
      for (std::size_t k = 0; k < 50; ++k) {  // one of every ten
        chosen.push_back(all[500 * surface + 10 * k + static_cast<std::size_t>(10 * random.next())]);
        chosen_area += chosen.back().area;
      }
      for (std::size_t k = first; k < chosen.size(); ++k) chosen[k].weight = chosen[k].area * area / chosen_area;
    }
    const Norms n = error_norms(chosen, synthetic::grey, every);
    covered += n.l2.low <= truth.l2 && truth.l2 <= n.l2.high;
    covered_l1 += n.l1.low <= truth.l1 && truth.l1 <= n.l1.high;
  }
  EXPECT_GE(covered, 912);
  EXPECT_GE(covered_l1, 912);
  EXPECT_LT(covered, 1000);
}

TEST(Norms, darkness_on_both_sides_is_agreement) {
  std::vector<Judged> judged = synthetic::judged({}, 1);
  for (Judged& j : judged) j.fem.value = j.mc.value = j.mc.standard_error = Spectrum::zero();
  const Norms n = error_norms(judged, synthetic::grey, every);
  EXPECT_EQ(n.l2.value, 0);
  EXPECT_EQ(n.l1.high, 0);
  EXPECT_EQ(n.max.value, 0);
  for (Judged& j : judged) j.fem.value = Spectrum(1);
  EXPECT_TRUE(std::isinf(error_norms(judged, synthetic::grey, every).l2.value));
}

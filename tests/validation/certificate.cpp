#include "validation/certificate.h"

#include <gtest/gtest.h>

#include <limits>

#include "synthetic.h"

using namespace interflect;
using namespace interflect::validation;

namespace {

Certificate certificate_of(const std::vector<Judged>& judged, const scene::Scene& scene = synthetic::scene(),
                           Settings settings = {}) {
  return certify(scene, judged, {}, {}, settings);
}

bool mentions(const std::vector<std::string>& lines, const std::string& text) {
  for (const std::string& line : lines)
    if (line.find(text) != std::string::npos) return true;
  return false;
}

}  // namespace

TEST(Certificate, good_data_pass_with_a_verdict_in_one_sentence) {
  const Certificate c = certificate_of(synthetic::judged({.spread = 0.01, .bound = 0.03}, 1));
  EXPECT_TRUE(c.passed) << c.verdict;
  EXPECT_TRUE(c.reasons.empty());
  EXPECT_EQ(c.verdict.rfind("Validated: FEM within 1.", 0), 0u) << c.verdict;
  EXPECT_NE(c.verdict.find(" % (L2 of H) of the path-traced reference, whose own 95 % error is 1."), std::string::npos)
      << c.verdict;
  EXPECT_NE(c.verdict.find(" %; bias "), std::string::npos) << c.verdict;
  EXPECT_EQ(c.elements, 500u);
}

TEST(Certificate, good_data_pass_at_every_seed) {
  // Chance fails a set at alpha = 0.01 only through the mean (a 501st part of it) and through a share below 0.99 (more
  // than 5 of 500 beyond 3 sigma plus a bound of 3 sigma: negligible).
  for (std::uint64_t seed = 0; seed < 200; ++seed)
    EXPECT_TRUE(certificate_of(synthetic::judged({.spread = 0.01, .bound = 0.03}, seed)).passed) << seed;
}

TEST(Certificate, planted_faults_fail) {
  // A bias of 5 sigma beyond the bounds, standard errors a third of what they are, a loss of 0.2 %, no bound at all.
  EXPECT_FALSE(certificate_of(synthetic::judged({.bias = 0.05}, 1)).passed);
  EXPECT_FALSE(certificate_of(synthetic::judged({.claimed_noise = 0.003}, 1)).passed);
  const Certificate loss = certificate_of(synthetic::judged({.count = 10000, .bias = -0.002}, 1));
  EXPECT_FALSE(loss.passed);
  EXPECT_TRUE(mentions(loss.reasons, "too dark everywhere"));
  const Certificate unknown = certificate_of(synthetic::judged({.bound = std::numeric_limits<double>::infinity()}, 1));
  EXPECT_FALSE(unknown.passed);
  EXPECT_TRUE(mentions(unknown.reasons, "lack a finite error bound"));
  EXPECT_EQ(unknown.verdict.rfind("Not validated: ", 0), 0u);
}

TEST(Certificate, what_statistics_cannot_know_is_a_reason_and_the_verdict_is_one) {
  Certificate c = certificate_of(synthetic::judged({.spread = 0.01, .bound = 0.03}, 1));
  const std::string measured = c.verdict.substr(std::string("Validated: ").size());
  add_reason("stopped", c);
  EXPECT_FALSE(c.passed);
  EXPECT_EQ(c.verdict, "Not validated: stopped; " + measured);
  add_reason("of no use", c);
  EXPECT_EQ(c.verdict, "Not validated: stopped; " + measured);
  EXPECT_EQ(c.reasons, (std::vector<std::string>{"stopped", "of no use"}));
}

TEST(Certificate, one_wrong_element_breaks_a_guarantee_and_is_remarked_upon_where_bounds_are_estimates) {
  std::vector<Judged> judged = synthetic::judged({.bound = 0.02, .claim = Claim::guaranteed}, 1);
  judged[42].fem.value *= 1.3;
  const Certificate broken = certificate_of(judged);
  EXPECT_FALSE(broken.passed);
  EXPECT_TRUE(mentions(broken.reasons, "guaranteed error bound is broken at element 42"));
  for (Judged& j : judged) j.fem.claim = Claim::estimated;
  const Certificate estimated = certificate_of(judged);
  EXPECT_TRUE(estimated.passed);
  EXPECT_TRUE(mentions(estimated.remarks, "element 42"));
}

// The worst of all need not be the one whose bound was guaranteed.
TEST(Certificate, names_the_measurement_whose_guarantee_is_broken) {
  std::vector<Judged> judged = synthetic::judged({.bound = 0.02}, 1);
  judged[7].fem.value *= 1.6;
  judged[42].fem.value *= 1.3;
  judged[42].fem.claim = Claim::guaranteed;
  const Certificate c = certificate_of(judged);
  EXPECT_TRUE(mentions(c.remarks, "the largest at element 7"));
  EXPECT_TRUE(mentions(c.reasons, "guaranteed error bound is broken at element 42"));
}

// 0.2 % at 1 % noise and bounds of 3 %: neither a single z nor their mean sees it.
TEST(Certificate, a_loss_that_bounds_would_explain_is_remarked_upon) {
  const Certificate loss = certificate_of(synthetic::judged({.count = 10000, .bias = -0.002, .bound = 0.03}, 1));
  EXPECT_TRUE(loss.passed) << loss.verdict;
  EXPECT_TRUE(mentions(loss.remarks, "FEM's mean is off beyond chance (95 % interval): illuminance -0.2"));
  EXPECT_NE(loss.verdict.find("; bias -0.2"), std::string::npos) << loss.verdict;
  EXPECT_FALSE(
      mentions(certificate_of(synthetic::judged({.count = 10000, .bound = 0.03}, 1)).remarks, "beyond chance"));
}

// At the level alpha: in 1 of 100 sets; 300 of them, 4 sigma = 7.
TEST(Certificate, a_bias_is_remarked_upon_by_chance_as_rarely_as_it_says) {
  int remarked = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed)
    remarked += mentions(certificate_of(synthetic::judged({.bound = 0.03}, seed)).remarks, "mean is off") ? 1 : 0;
  EXPECT_LE(remarked, 3 + 7);
}

// Surfaces, all of them judged, tell the mean better than chosen elements do.
TEST(Certificate, the_bias_is_told_by_what_knows_it_better) {
  std::vector<Judged> judged = synthetic::judged({}, 1);
  for (const Judged& j : synthetic::judged({.noise = 1e-4, .claimed_noise = 1e-4, .bias = 0.01}, 2)) {
    judged.push_back(j);
    judged.back().kind = Judged::Kind::surface;
  }
  const Judgement j = certificate_of(judged).judgements[0];
  EXPECT_EQ(j.bias().value, j.surfaces.bias.value);
  EXPECT_NEAR(j.bias().value, 0.01, 1e-4);
}

TEST(Certificate, a_reference_that_is_too_noisy_judges_nothing) {
  const Certificate c = certificate_of(synthetic::judged({.noise = 0.1, .claimed_noise = 0.1}, 1));
  EXPECT_FALSE(c.passed);
  EXPECT_TRUE(mentions(c.reasons, "too noisy to judge by"));
}

TEST(Certificate, overestimated_standard_errors_are_remarked_upon) {
  EXPECT_TRUE(mentions(certificate_of(synthetic::judged({.noise = 0.005}, 1)).remarks, "overestimated"));
  EXPECT_FALSE(mentions(certificate_of(synthetic::judged({}, 1)).remarks, "overestimated"));
}

TEST(Certificate, a_fault_in_one_channel_fails_though_the_weighted_value_agrees) {
  scene::Scene scene = synthetic::scene({"r", "g", "b"});
  scene.weights[0] = 0.2;
  scene.weights[1] = 0.79;
  scene.weights[2] = 0.01;
  std::vector<Judged> judged = synthetic::judged({.bound = 0.01}, 1);
  for (Judged& j : judged) j.fem.value[2] *= 1.1;
  const Certificate c = certificate_of(judged, scene);
  ASSERT_EQ(c.judgements.size(), 4u);
  EXPECT_GE(c.judgements[0].comparison.share, 0.99);
  EXPECT_LT(c.judgements[3].comparison.share, 0.5);
  EXPECT_FALSE(c.passed);
  EXPECT_EQ(c.comparisons, 4u * 501u);
}

TEST(Certificate, the_worst_surface_is_named_and_emitters_are_left_out_where_asked) {
  std::vector<Judged> judged = synthetic::judged({.noise = 0, .claimed_noise = 0, .bound = 1}, 1);
  for (Judged& j : judged) j.kind = Judged::Kind::surface;
  judged[50].fem.value *= 1.1;  // emits: a multiple of ten
  const Certificate c = certificate_of(judged);
  EXPECT_EQ(c.worst_surface, "element 50");
  EXPECT_NEAR(c.worst_surface_difference, 0.1, 1e-12);
  EXPECT_GT(c.judgements[0].surfaces.l2.value, 1e-3);
  EXPECT_LT(c.judgements[0].surfaces_dark.l2.value, 1e-12);
  EXPECT_EQ(c.judgements[0].surfaces_dark.measurements, 450u);
}

TEST(Certificate, expectations_of_the_scene_are_checked_against_both_methods) {
  scene::Scene scene = synthetic::scene();
  using Statistic = scene::Expected::Statistic;
  scene.expected = {{"desk", Statistic::mean, 200, 0.01, "a book"},
                    {"desk", Statistic::min, 100, 0.01, ""},
                    {"desk", Statistic::max, 300, 0.01, ""},
                    {"desk", Statistic::mean, 210, 0.01, ""},
                    {"chair", Statistic::mean, 1, 0.01, ""}};
  std::vector<Judged> judged = synthetic::judged({}, 1);
  for (int i = 0; i < 3; ++i) {
    Judged point;
    point.kind = Judged::Kind::sensor;
    point.group = "desk";
    point.name = "desk[" + std::to_string(i) + "]";
    point.fem = {Spectrum(100 + 100 * i), Spectrum::zero(), Spectrum(1), Claim::estimated, 0};
    point.mc = unbiased_estimate(Spectrum(100.5 + 100 * i), Spectrum(0.5), 100);
    judged.push_back(point);
  }
  const Certificate c = certificate_of(judged, scene);
  ASSERT_EQ(c.expected.size(), 5u);
  EXPECT_DOUBLE_EQ(c.expected[0].fem, 200);
  EXPECT_DOUBLE_EQ(c.expected[0].mc, 200.5);
  EXPECT_NEAR(c.expected[0].mc_standard_error, 0.5 / std::sqrt(3.0), 1e-12);
  EXPECT_TRUE(c.expected[0].passed() && c.expected[1].passed() && c.expected[2].passed());
  EXPECT_FALSE(c.expected[3].passed());  // 5 % off
  EXPECT_FALSE(c.expected[4].passed());  // no such points
  EXPECT_TRUE(mentions(c.reasons, "sensor desk: mean is 200 by FEM"));
}

/// A sensor of points that are all 100 by FEM; by path tracing as given, with a standard error of 1.
Certificate extremes(const std::vector<double>& traced, scene::Expected::Statistic statistic) {
  scene::Scene scene = synthetic::scene();
  scene.expected = {{"desk", statistic, 100, 0, ""}};
  std::vector<Judged> judged;
  for (double value : traced) {
    Judged point;
    point.kind = Judged::Kind::sensor;
    point.group = "desk";
    point.fem = {Spectrum(100), Spectrum::zero(), Spectrum(1), Claim::estimated, 0};
    point.mc = unbiased_estimate(Spectrum(value), Spectrum(1), 100);
    judged.push_back(point);
  }
  return certificate_of(judged, scene);
}

// Of 1 000 normal numbers the least lies at -3.24 in the mean: 3 standard errors of one would refuse most sensors.  The
// limit of all is 4.7; that of one point stays at 3.
TEST(Certificate, the_least_of_many_noisy_points_may_lie_as_low_as_chance_puts_it) {
  using Statistic = scene::Expected::Statistic;
  std::vector<double> many(1000, 100.0);
  for (const double off : {3.9, 5.0}) {
    many[7] = 100 - off;
    EXPECT_EQ(extremes(many, Statistic::min).expected[0].mc_agrees, off < 4.5) << off;
    many[7] = 100 + off;
    EXPECT_EQ(extremes(many, Statistic::max).expected[0].mc_agrees, off < 4.5) << off;
    EXPECT_EQ(extremes({100 + off}, Statistic::min).expected[0].mc_agrees, false) << off;
    many[7] = 100;
  }
  EXPECT_TRUE(extremes({102.9}, Statistic::max).expected[0].mc_agrees);
  // Nor may all points lie above what is expected of the least.
  EXPECT_FALSE(extremes(std::vector<double>(1000, 105.0), Statistic::min).expected[0].mc_agrees);
}

TEST(Certificate, nothing_judged_is_not_a_pass) { EXPECT_FALSE(certificate_of({}).passed); }

// Where both say 0 they agree, of whatever is wrong with either.
TEST(Certificate, darkness_is_not_a_pass) {
  std::vector<Judged> judged = synthetic::judged({}, 1);
  for (Judged& each : judged) {
    each.fem.value = each.mc.value = Spectrum::zero();
    each.fem.error_bound = each.mc.standard_error = Spectrum::zero();
  }
  const Certificate dark = certificate_of(judged);
  EXPECT_FALSE(dark.passed);
  EXPECT_EQ(dark.reasons, (std::vector<std::string>{"no light reaches what was judged, which tells nothing"}));
}

TEST(Certificate, a_sampled_balance_adds_what_surfaces_absorb_with_its_error) {
  const double areas[] = {2, 3};
  const Spectrum reflectances[] = {Spectrum(0.5), Spectrum(0)};
  const Estimate irradiance[] = {unbiased_estimate(Spectrum(10), Spectrum(0.3), 9),
                                 unbiased_estimate(Spectrum(20), Spectrum(0.1), 9)};
  const EnergyBalance b = sampled_energy(Spectrum(100), areas, reflectances, irradiance);
  EXPECT_DOUBLE_EQ(b.absorbed[0], 70);
  EXPECT_DOUBLE_EQ(b.lost[0], 30);
  EXPECT_NEAR(b.standard_error[0], std::hypot(0.3, 0.3), 1e-15);
  EXPECT_FALSE(b.on_backs.has_value());  // it is not known what of the loss hit backs
  EXPECT_FALSE(b.residual.has_value());
}

#include "montecarlo/rare_light.h"

#include "montecarlo/integrators.h"
#include "montecarlo/sample_report.h"
#include "tests/montecarlo/statistics.h"
#include "tests/montecarlo/sun_and_mirror.h"

// A sun as small as ours beside a mirror: one path in 46 223 meets it that way, and no way can be drawn to it.
namespace interflect::montecarlo {
namespace {

using scene::Sun;

struct Answered {
  Estimate flux, point;
  std::string rare;
};
Answered answer(const std::string& name, const scene::Scene& scene, std::uint64_t samples, double target = .1) {
  core::LocalRun run(6, 2);
  SampleReport report;
  IntegratorSettings settings;
  settings.samples = samples, settings.target = target, settings.report = &report;
  const auto [flux, point, pixel] = test::asked_of_sun_and_mirror(scene, 1);
  const std::vector<measure::Measurement> asked{flux, point};
  const auto found = make_integrator(name, settings)->answer(scene, asked, run.get());
  return {found[0], found[1], report.rare};
}

bool holds(const Estimate& estimate, double truth) {
  return std::abs(estimate.value[0] - truth) <= normal_95 * estimate.standard_error[0];
}

// 4 096 paths meet it by chance in one case of eleven: their errors allow for it, and say so.
TEST(RareLight, is_in_the_errors_of_few_samples) {
  const scene::Scene scene = test::sun_and_mirror(1, Sun::seen_from_earth);
  const Answered by_path = answer("path", scene, 4096);
  EXPECT_TRUE(holds(by_path.flux, test::under_sun_and_mirror)) << by_path.flux.value[0];
  EXPECT_TRUE(holds(by_path.point, test::under_sun_and_mirror)) << by_path.point.value[0];
  EXPECT_LE(by_path.flux.standard_error[0], 2) << "as much as the sun, H = 1, or one find of it, 11";
  EXPECT_NE(by_path.rare.find("light of sun by way of mirrors"), std::string::npos) << by_path.rare;

  const Answered by_both = answer("bidirectional", scene, 4096);
  EXPECT_TRUE(holds(by_both.flux, test::under_sun_and_mirror));
  EXPECT_LE(by_both.flux.standard_error[0], .05) << "walks from the sun meet the floor";
  EXPECT_TRUE(holds(by_both.point, test::under_sun_and_mirror));
  EXPECT_NE(by_both.rare.find("light of sun by way of mirrors"), std::string::npos) << by_both.rare;
}

// To a target as many are taken as meet it.
TEST(RareLight, is_met_where_there_is_a_target) {
  for (const double angle : {Sun::seen_from_earth, pi / 180}) {
    const scene::Scene scene = test::sun_and_mirror(1, angle);
    const Answered by_path = answer("path", scene, 0);
    const double needed = 10 / std::pow(std::sin(angle), 2), z = test::critical_z(1e-3, 4);
    EXPECT_EQ(by_path.rare, "");
    for (const Estimate& each : {by_path.flux, by_path.point}) {
      EXPECT_GE(static_cast<double>(each.samples), needed);
      EXPECT_LE(std::abs(each.value[0] - test::under_sun_and_mirror), z * each.standard_error[0]);
      EXPECT_LE(each.standard_error[0], .64) << "of some ten finds of .64 in all";
    }
  }
}

TEST(RareLight, is_none_without_a_mirror_or_where_it_is_large_or_not_asked_for) {
  const auto all = measure::PathClasses::all();
  const scene::Scene scene = test::sun_and_mirror(1, Sun::seen_from_earth);
  const auto rare = rare_light(scene, all);
  ASSERT_TRUE(rare);
  EXPECT_EQ(rare->light, "sun");
  EXPECT_NEAR(rare->chance, std::pow(std::sin(Sun::seen_from_earth), 2), 1e-12);
  EXPECT_NEAR(rare->pi_radiance[0] * rare->chance, 1, 1e-9);
  EXPECT_FALSE(rare_light(scene, measure::PathClasses::of("L(D|G)*E")));
  EXPECT_FALSE(rare_light(test::sun_and_mirror(1, 0), all)) << "is refused instead";
  EXPECT_FALSE(rare_light(test::furnished(1), all));
}

}  // namespace
}  // namespace interflect::montecarlo

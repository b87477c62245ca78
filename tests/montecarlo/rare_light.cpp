#include "montecarlo/rare_light.h"

#include "montecarlo/integrators.h"
#include "montecarlo/sample_report.h"
#include "tests/montecarlo/statistics.h"
#include "tests/montecarlo/sun_and_mirror.h"

// A sun as small as ours beside a mirror: one path in 46 223 meets it that way, and no way can be drawn to it.
namespace interflect::montecarlo {
namespace {

using scene::Sun;
const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();

Estimate answer(const std::string& name, const scene::Scene& scene, const measure::Measurement& asked,
                std::uint64_t samples, std::uint64_t seed = 6, SampleReport* report = nullptr) {
  core::LocalRun run(seed, 2);
  IntegratorSettings settings;
  settings.samples = samples, settings.target = .1, settings.report = report;
  return make_integrator(name, settings)->answer(scene, {&asked, 1}, run.get())[0];
}

bool holds(const Estimate& estimate, double truth) {
  return std::abs(estimate.value[0] - truth) <= normal_95 * estimate.standard_error[0];
}

// 4 096 paths meet it by chance in one case of eleven: their errors allow for it, and say so.
TEST(RareLight, is_in_the_errors_of_few_samples) {
  const scene::Scene scene = test::sun_and_mirror(1, Sun::seen_from_earth);
  const auto asked = test::asked_of_sun_and_mirror(scene, 1);
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    for (const measure::Measurement& each : {asked.flux, asked.point}) {
      SampleReport report;
      const Estimate by_path = answer("path", scene, each, 4096, seed, &report);
      EXPECT_TRUE(holds(by_path, test::under_sun_and_mirror)) << by_path.value[0];
      EXPECT_LE(by_path.standard_error[0], 16) << "as much as the sun, H = 1, or as two finds of it, 9 each";
      if (by_path.standard_error[0] < 2) {
        EXPECT_NE(report.rare.find("light of sun by way of mirrors"), std::string::npos);
      }
    }
  SampleReport report;
  const Estimate by_both = answer("bidirectional", scene, asked.flux, 4096, 6, &report);
  EXPECT_TRUE(holds(by_both, test::under_sun_and_mirror));
  EXPECT_LE(by_both.standard_error[0], .05) << "walks from the sun meet the floor";
  EXPECT_EQ(report.rare, "");
  EXPECT_TRUE(holds(answer("bidirectional", scene, asked.point, 4096), test::under_sun_and_mirror));
}

// A patch of a square centimetre, which walks from the sun hardly ever meet.
TEST(RareLight, is_in_the_errors_of_small_patches_by_both_ways) {
  const scene::Scene scene = test::sun_and_mirror(1, Sun::seen_from_earth);
  auto small = measure::patches_of(scene, test::surface_named(scene, "floor"), scene::Side::front)[0];
  const Vec3 middle(.5, .3, 0), corner = small.corner[0];
  for (std::size_t k = 0; k < small.corners; ++k) small.corner[k] = middle + .01 * (small.corner[k] - corner);
  small.area *= 1e-4;
  for (std::uint64_t seed = 1; seed <= 12; ++seed)
    EXPECT_TRUE(
        holds(answer("bidirectional", scene, measure::PatchIrradiance{small}, 4096, seed), test::under_sun_and_mirror))
        << seed;
}

// To a target as many are taken as bring what may be missed below it, or meet it: 1.7 million, noise .64 / sqrt(30).
TEST(RareLight, is_met_where_there_is_a_target) {
  const scene::Scene scene = test::sun_and_mirror(1, Sun::seen_from_earth);
  const Estimate found = answer("path", scene, test::asked_of_sun_and_mirror(scene, 1).flux, 0);
  EXPECT_LE(std::abs(found.value[0] - test::under_sun_and_mirror), test::critical_z(1e-3, 1) * found.standard_error[0]);
  EXPECT_LE(found.standard_error[0], .15 * test::under_sun_and_mirror);
}

// Aslant a tenth of those meet it.
TEST(RareLight, is_met_aslant) {
  const scene::Scene scene = test::sun_and_mirror(1, Sun::seen_from_earth, Vec3(std::sqrt(.99), 0, -.1));
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Estimate found = answer("path", scene, test::asked_of_sun_and_mirror(scene, 1).flux, 0, seed);
    EXPECT_LE(std::abs(found.value[0] - .18), test::critical_z(1e-3, 3) * found.standard_error[0]) << seed;
    EXPECT_GE(found.standard_error[0], .18 / 30) << "of some ten finds";
  }
}

// Another light, smaller and faint, does not stand for it; a light nearby is met more often than at the scene's size.
TEST(RareLight, is_each_light_that_may_be_met_so) {
  scene::Scene scene = test::sun_and_mirror(1, Sun::seen_from_earth);
  scene.lights.spheres.push_back({"led", Vec3(.2, .2, .5), .001, test::grey(1)});
  const auto asked = test::asked_of_sun_and_mirror(scene, 1);
  EXPECT_TRUE(holds(answer("path", scene, asked.flux, 4096), test::under_sun_and_mirror));
  const RareLights both(scene, measure::PathClasses::all()), led(scene, measure::PathClasses::of("A.*E"));
  EXPECT_NEAR(led.lacks(1000)[0], 3e-3, 1e-12);
  EXPECT_NEAR(both.lacks(1000)[0], std::hypot(1, 3e-3), 1e-9);
  EXPECT_NE(both.text(scene, 1000).find("light of sun"), std::string::npos);
  EXPECT_EQ(both.lacks(100'000'000'000)[0], 0);
}

// Without ways to lights all light is of that kind: a sun over a floor, below a sky.
TEST(RareLight, is_all_without_next_event_estimation) {
  scene::SceneBuilder builder({"grey"});
  builder.add_polygon("floor", test::parallelogram(Vec3::Zero(), x, y),
                      builder.add_material(test::diffuse("grey", .5, 0)));
  builder.scene().lights.suns.push_back({.name = "sun", .direction = Vec3(0, 0, -1), .irradiance = test::grey(10)});
  scene::Sky sky{};
  sky.radiance = test::grey(inv_pi), sky.up = z;
  builder.scene().lights.sky = sky;
  const scene::Scene scene = builder.finish();
  const measure::Measurement point = measure::PointIrradiance{Vec3(.5, .5, .1), z, {}};
  for (const std::uint64_t samples : {4096u, 0u}) {
    const Estimate found = answer("unidirectional", scene, point, samples);
    EXPECT_TRUE(holds(found, 11)) << found.value[0] << " +- " << found.standard_error[0];
  }
}

TEST(RareLight, is_none_without_a_mirror_or_where_it_is_not_asked_for) {
  const auto all = measure::PathClasses::all();
  const scene::Scene scene = test::sun_and_mirror(1, Sun::seen_from_earth);
  EXPECT_FALSE(RareLights(scene, all).empty());
  EXPECT_TRUE(RareLights(scene, measure::PathClasses::of("L(D|G)*E")).empty());
  EXPECT_TRUE(RareLights(test::sun_and_mirror(1, 0), all).empty()) << "is refused instead";
  EXPECT_TRUE(RareLights(test::furnished(1), all).empty());
}

}  // namespace
}  // namespace interflect::montecarlo

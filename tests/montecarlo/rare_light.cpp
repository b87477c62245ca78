#include "montecarlo/rare_light.h"

#include "core/format.h"
#include "montecarlo/integrators.h"
#include "montecarlo/render.h"
#include "montecarlo/sample_report.h"
#include "tests/montecarlo/statistics.h"
#include "tests/montecarlo/sun_and_mirror.h"

// A sun as small as ours beside a mirror: one path in 46 223 meets it that way, and no way can be drawn to it.
namespace interflect::montecarlo {
namespace {

using scene::Sun;
const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();

constexpr double target = .1;
double squared(double a) { return a * a; }

Estimate answer(const std::string& name, const scene::Scene& scene, const measure::Measurement& asked,
                std::uint64_t samples, std::uint64_t seed = 6, SampleReport* report = nullptr,
                const measure::PathClasses& paths = measure::PathClasses::all()) {
  core::LocalRun run(seed, 2);
  IntegratorSettings settings;
  settings.samples = samples, settings.target = target, settings.report = report, settings.paths = paths;
  return make_integrator(name, settings)->answer(scene, {&asked, 1}, run.get())[0];
}

bool holds(const Estimate& estimate, double truth) {
  return std::abs(estimate.value[0] - truth) <= normal_95 * estimate.standard_error[0];
}

RareLights rare_in(const scene::Scene& scene, const measure::PathClasses& paths = measure::PathClasses::all(),
                   NextEvent next_event = NextEvent::yes) {
  return {scene, LightSet(scene), paths, next_event};
}

const RareLights::From anywhere{geometry::Box(Vec3::Zero(), Vec3(1, 1, 2))};

/// All of the sun that a path finds, H / sin² of its angle.
double find_of(const scene::Scene& scene) { return pi * scene.lights.suns[0].radiance()[0]; }

// Three finds where none was met; no more than the sun sends by one mirror; nothing where it is met a hundred times.
TEST(RareLight, may_be_three_finds_or_what_a_mirror_shows) {
  for (const double scale : {1e-6, 1.0, 1e6}) {
    const scene::Scene scene = test::sun_and_mirror(scale, Sun::seen_from_earth);
    const RareLights rare = rare_in(scene);
    const double find = find_of(scene);
    const RareLights::From from{scene.box()};
    EXPECT_NEAR(find, 46223, 1);
    EXPECT_DOUBLE_EQ(rare.lacks(4096, from)[0], 1);
    EXPECT_DOUBLE_EQ(rare.lacks(1'000'000, from)[0], 3 * find / 1e6);
    EXPECT_EQ(rare.lacks(4'630'000, from)[0], 0);
    EXPECT_EQ(rare.samples_for(1, from), 0) << "as little it is without a sample";
    EXPECT_NEAR(rare.samples_for(.1, from), 3 * find / .1, 1);
    EXPECT_NEAR(rare.samples_for(.01, from), 100 * find, 100);
  }
}

TEST(RareLight, may_be_shown_by_each_mirror) {
  scene::SceneBuilder builder = test::beside_a_sun();
  const auto mirror = builder.add_material(test::finished(scene::Mirror{test::grey(.8)}));
  for (int k = 1; k < 10; ++k)
    builder.add_polygon("wall" + std::to_string(k), test::parallelogram(x + k * y, 2 * z, y), mirror);
  const scene::Scene scene = builder.finish();
  EXPECT_DOUBLE_EQ(rare_in(scene).lacks(4096, anywhere)[0], 10);
}

// A walk from the sun finds a patch as often as it meets it, if it is the sun from which it sets out.
TEST(RareLight, is_met_by_walks_too_if_they_set_out_from_it) {
  scene::SceneBuilder builder = test::beside_a_sun();
  builder.add_polygon("lamp", test::parallelogram(Vec3(0, 0, -.5), y, x),
                      builder.add_material(test::diffuse("lamp", 0, 1e6)));
  const scene::Scene bright = builder.finish(), plain = test::sun_and_mirror(1, Sun::seen_from_earth);
  const double mirrored = 2 / LightSet(plain).section();
  const RareLights::From met{plain.box(), false, .009 / mirrored};
  EXPECT_EQ(rare_in(plain).lacks(12'000, met)[0], 0);
  EXPECT_NEAR(rare_in(plain).lacks(400, met)[0], 3. / 400 / .009, 1e-9) << "a find by a walk is H over its chance";
  EXPECT_DOUBLE_EQ(rare_in(bright, measure::PathClasses::of("F.*E")).lacks(4096, met)[0], 1);

  const auto floor = test::asked_of_sun_and_mirror(bright, 1).flux;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Estimate found = answer("bidirectional", bright, floor, 4096, seed);
    EXPECT_TRUE(holds(found, test::under_sun_and_mirror)) << found.value[0] << " +- " << found.standard_error[0];
  }
  const Estimate by_both = answer("bidirectional", plain, test::asked_of_sun_and_mirror(plain, 1).flux, 4096);
  EXPECT_LE(std::abs(by_both.value[0] - test::under_sun_and_mirror),
            test::critical_z(1e-3, 1) * by_both.standard_error[0]);
  EXPECT_LE(by_both.standard_error[0], .05) << "3 % of it: walks from the sun meet the floor";
}

// 4 096 paths meet it by chance in one case of eleven or so: the errors of the others allow for it, and say so.
TEST(RareLight, is_in_the_errors_of_few_samples) {
  const scene::Scene scene = test::sun_and_mirror(1, Sun::seen_from_earth);
  const auto asked = test::asked_of_sun_and_mirror(scene, 1);
  int missed = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    for (const measure::Measurement& each : {asked.flux, asked.point}) {
      SampleReport report;
      const Estimate by_path = answer("path", scene, each, 4096, seed, &report);
      EXPECT_TRUE(holds(by_path, test::under_sun_and_mirror)) << by_path.value[0];
      if (by_path.value[0] > 1) continue;
      ++missed;
      EXPECT_NEAR(by_path.value[0], .8, .01);
      EXPECT_NEAR(by_path.standard_error[0], 1, 1e-3) << "H, and next to no noise";
      EXPECT_NE(report.rare.find("light of sun by way of mirrors"), std::string::npos);
    }
  EXPECT_GE(missed, 28) << "37 expected of 40, exp(-.8 * 4096 / 46223) of each";
}

// A patch of a square centimetre, which walks from the sun hardly ever meet.
TEST(RareLight, is_in_the_errors_of_small_patches_by_both_ways) {
  const scene::Scene scene = test::sun_and_mirror(1, Sun::seen_from_earth);
  auto small = measure::patches_of(scene, test::surface_named(scene, "floor"), scene::Side::front)[0];
  const Vec3 middle(.5, .3, 0), corner = small.corner[0];
  for (std::size_t k = 0; k < small.corners; ++k) small.corner[k] = middle + .01 * (small.corner[k] - corner);
  small.area *= 1e-4;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const Estimate found = answer("bidirectional", scene, measure::PatchIrradiance{small}, 4096, seed);
    EXPECT_TRUE(holds(found, test::under_sun_and_mirror)) << seed;
    if (found.value[0] < 1) {
      EXPECT_GE(found.standard_error[0], 1);
    }
  }
}

// To a target as many are taken as bring both what may be missed and the noise below it.
TEST(RareLight, is_met_where_there_is_a_target) {
  const scene::Scene scene = test::sun_and_mirror(1, Sun::seen_from_earth);
  for (std::uint64_t seed = 6; seed <= 8; ++seed) {
    const Estimate found = answer("path", scene, test::asked_of_sun_and_mirror(scene, 1).flux, 0, seed);
    EXPECT_LE(std::abs(found.value[0] - test::under_sun_and_mirror),
              test::critical_z(1e-3, 3) * found.standard_error[0]);
    EXPECT_LE(found.standard_error[0], std::sqrt(2) * target * test::under_sun_and_mirror);
  }
}

// Aslant a tenth of those meet it.
TEST(RareLight, is_met_aslant) {
  const scene::Scene scene = test::sun_and_mirror(1, Sun::seen_from_earth, Vec3(std::sqrt(.99), 0, -.1));
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Estimate found = answer("path", scene, test::asked_of_sun_and_mirror(scene, 1).flux, 0, seed);
    EXPECT_LE(std::abs(found.value[0] - .18), test::critical_z(1e-3, 3) * found.standard_error[0]) << seed;
  }
}

// Beside a mirror that shows nothing metal may throw it too.  Glass bends light less than it mirrors it.
TEST(RareLight, is_thrown_by_metal_beside_mirrors_and_by_glass) {
  const auto samples_by = [](const scene::Finish& finish) {
    const scene::Scene scene = test::beside_a_sun(finish).finish();
    return rare_in(scene).samples_for(1e-9, anywhere);
  };
  EXPECT_NEAR(samples_by(scene::Glass{1.1, .1}), 100 / squared(.1 * (1 - 1 / 1.1)), 1e-6);
  EXPECT_NEAR(samples_by(scene::Glass{1.5, .2}), 100 / squared(.2 / 3), 1e-6);
  EXPECT_EQ(samples_by(scene::Glass{1.5, .8}), 0);

  scene::SceneBuilder builder = test::beside_a_sun(scene::Metal{test::grey(.8), .005});
  builder.add_polygon("below", test::parallelogram(Vec3(0, 0, -3), y, x),
                      builder.add_material(test::finished(scene::Mirror{test::grey(.8)})));
  const scene::Scene scene = builder.finish();
  const auto point = test::asked_of_sun_and_mirror(scene, 1).point;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Estimate found = answer("path", scene, point, 4096, seed, nullptr, measure::PathClasses::of("FE|FG.*E"));
    EXPECT_TRUE(holds(found, test::under_sun_and_mirror)) << found.value[0];
  }
}

// Nearly smooth metal throws it as a mirror does: into its lobe or not at all.  Compensated, it reflects .8.
TEST(RareLight, is_thrown_by_nearly_smooth_metal) {
  const auto with_metal = [](double roughness) {
    return test::beside_a_sun(scene::Metal{test::grey(.8), roughness}).finish();
  };
  const scene::Scene scene = with_metal(.005);
  EXPECT_DOUBLE_EQ(rare_in(scene).lacks(10'000, anywhere)[0], 1) << "3 H of 10 000 samples x 1e-4, and no more than H";
  EXPECT_DOUBLE_EQ(rare_in(scene).lacks(100'000, anywhere)[0],
                   3 * find_of(scene) * scene.lights.suns[0].squared_sine() / 10);
  EXPECT_EQ(rare_in(scene).lacks(1'000'000, anywhere)[0], 0);
  EXPECT_TRUE(rare_in(with_metal(.2)).empty());
  for (const double roughness : {.0011, .005})
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const auto asked = test::asked_of_sun_and_mirror(scene, 1).point;
      const Estimate found = answer("path", with_metal(roughness), asked, 4096, seed);
      EXPECT_TRUE(holds(found, test::under_sun_and_mirror)) << roughness << ": " << found.value[0];
    }
}

// A trees' branch from rough metal to a mirror: pixels of it by rays that chance alone leads to the sun.
TEST(RareLight, is_in_the_errors_of_pixels_by_trees_of_rays) {
  scene::Scene scene = test::sun_and_mirror(1, Sun::seen_from_earth);
  for (scene::Material& material : scene.materials)
    if (material.name == "grey") material.finish = scene::Metal{test::grey(.8), .3};
  const auto paths = measure::PathClasses::of("FSGE");
  const Estimate few =
      answer("distributed", scene, test::asked_of_sun_and_mirror(scene, 1).pixel, 4096, 6, nullptr, paths);
  EXPECT_EQ(few.value[0], 0);
  EXPECT_NEAR(few.standard_error[0], inv_pi, 1e-2) << "H by a mirror, and three largest finds of none";
}

// Pictures say what their errors do not know, where it may be.
TEST(RareLight, is_told_of_pictures) {
  const auto told = [](const char* integrator, const scene::Scene& scene) {
    RenderSettings settings;
    settings.integrator = integrator, settings.samples = 4;
    core::LocalRun run;
    return render(scene, {0}, settings, run.get(), *raycast::make_ray_caster("embree", scene)).report.rare;
  };
  const scene::Scene scene = test::sun_and_mirror(1, Sun::seen_from_earth);
  EXPECT_NE(told("path", scene).find("light of sun by way of mirrors"), std::string::npos) << told("path", scene);
  EXPECT_NE(told("unidirectional", scene).find("light of sun is met by one path in 46223"), std::string::npos);
  EXPECT_EQ(told("bidirectional", scene), "");
  EXPECT_EQ(told("path", test::facing_squares()), "");
}

// Another light, smaller and faint, does not stand for it; a light nearby is met more often than at the scene's size.
TEST(RareLight, is_each_light_that_may_be_met_so) {
  scene::Scene scene = test::sun_and_mirror(1, Sun::seen_from_earth);
  scene.lights.spheres.push_back({"led", Vec3(.2, .2, .5), .001, test::grey(1)});
  const auto asked = test::asked_of_sun_and_mirror(scene, 1);
  SampleReport report;
  EXPECT_TRUE(holds(answer("path", scene, asked.flux, 4096, 6, &report), test::under_sun_and_mirror));
  EXPECT_NE(report.rare.find("light of sun"), std::string::npos);
  const RareLights both = rare_in(scene), led = rare_in(scene, measure::PathClasses::of("A.*E"));
  EXPECT_NEAR(led.lacks(1000, anywhere)[0], 3e-3, 1e-12);
  EXPECT_NEAR(both.lacks(1000, anywhere)[0], std::hypot(1, 3e-3), 1e-9);
  EXPECT_EQ(both.lacks(100'000'000'000, anywhere)[0], 0);
}

// A lamp is what it is, however its surface is cut; lamps alike are missed together, and met when each of them is.
TEST(RareLight, is_of_lamps_and_not_of_their_parts) {
  const auto lit_by = [](int cuts, int lamps, double apart) {
    scene::SceneBuilder builder({"grey"});
    builder.add_polygon("wall", test::parallelogram(x, 2 * z, y),
                        builder.add_material(test::finished(scene::Mirror{test::grey(.8)})));
    const auto bright = builder.add_material(test::diffuse("bright", 0, 100));
    for (int lamp = 0; lamp < lamps; ++lamp)
      for (int i = 0; i < cuts; ++i)
        for (int j = 0; j < cuts; ++j) {
          const Vec3 corner = Vec3(.2 * i / cuts, .2 * j / cuts + lamp * apart, 2);
          builder.add_polygon(core::format("%d %d %d", lamp, i, j),
                              test::parallelogram(corner, .2 / cuts * y, .2 / cuts * x), bright);
        }
    return builder.finish();
  };
  const scene::Scene whole = lit_by(1, 1, 0), cut = lit_by(8, 1, 0), three = lit_by(4, 3, .3);
  for (const std::uint64_t samples : {100u, 1000u, 3000u, 10'000u}) {
    const double lacked = rare_in(whole).lacks(samples, anywhere)[0];
    EXPECT_NEAR(rare_in(cut).lacks(samples, anywhere)[0], lacked, 1e-9) << samples;
    if (samples < 3000) {
      EXPECT_NEAR(rare_in(three).lacks(samples, anywhere)[0], lacked, 1e-9) << samples;
    }
  }
  EXPECT_NEAR(rare_in(whole).lacks(1000, anywhere)[0], .3, 1e-12);
  EXPECT_EQ(rare_in(whole).lacks(100'000, anywhere)[0], 0);
}

// Of a large ground around the room no lamp is met less; far away it is, and from far away.
TEST(RareLight, is_as_rare_as_it_is_far) {
  const auto with_ball = [](double ground, double away) {
    scene::SceneBuilder builder({"grey"});
    builder.add_polygon("ground", test::parallelogram(Vec3(-ground, -ground, 0), 2 * ground * x, 2 * ground * y),
                        builder.add_material(test::diffuse("grey", .5, 0)));
    builder.add_polygon("wall", test::parallelogram(x, 2 * z, y),
                        builder.add_material(test::finished(scene::Mirror{test::grey(.8)})));
    builder.scene().lights.spheres.push_back(
        {"ball", Vec3(.5, .5, 1) - away * Vec3(.6, 0, -.8), .02 * away, test::grey(1)});
    return builder.finish();
  };
  const auto samples = [&](double ground, double away, const Vec3& from) {
    const scene::Scene scene = with_ball(ground, away);
    return rare_in(scene).samples_for(1e-15, {geometry::Box(from)});
  };
  const Vec3 desk(.5, .5, .5);
  const double near = samples(1, 1, desk), as_it_looks = 100 / squared(.02);
  EXPECT_EQ(samples(500, 1, desk), near);
  EXPECT_NEAR(samples(1, 1000, desk), as_it_looks, .01 * as_it_looks);
  EXPECT_NEAR(samples(1, 1, desk - 1000 * x), 1e6 * as_it_looks, .01 * 1e6 * as_it_looks);
}

// A ball as large as the sun looks, a hundred metres off, is one.
TEST(RareLight, is_in_the_errors_beside_what_is_far) {
  scene::Scene scene = test::sun_and_mirror(1, Sun::seen_from_earth);
  scene.lights.suns.clear();
  const double away = 100, radius = .5, E = squared(away / radius);
  scene.lights.spheres.push_back({"ball", Vec3(.5, .5, 0) - away * Vec3(.6, 0, -.8), radius, test::grey(E)});
  const auto asked = test::asked_of_sun_and_mirror(scene, 1);
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Estimate found = answer("path", scene, asked.flux, 4096, seed);
    EXPECT_GE(found.standard_error[0], 3 * E / 4096);
    EXPECT_TRUE(holds(found, test::under_sun_and_mirror));
  }
}

// So is the sun of a picture of the sky, a texel of it.
TEST(RareLight, is_the_sun_of_a_picture_of_the_sky) {
  scene::Scene scene = test::sun_and_mirror(1, Sun::seen_from_earth);
  scene.lights.suns.clear();
  const int rows = 256, columns = 512;
  const double L = 1e5;
  std::vector<Spectrum> texels(rows * columns, test::grey(1));
  texels[60 * columns + 100] = test::grey(L);
  const scene::EnvironmentMap map(z, y, rows, columns, texels);
  scene.lights.sky = map;
  const RareLights rare = rare_in(scene);
  const double solid_angle = map.solid_angle(60);
  EXPECT_NEAR(rare.lacks(4096, anywhere)[0], L * solid_angle, 1e-9 * L);
  EXPECT_NEAR(rare.samples_for(1e-9, anywhere), 100 * pi / solid_angle, 10);
}

// What a floor in a mirror shows of it walks from the sun cannot bring to a pixel.
TEST(RareLight, is_in_the_errors_of_pixels_by_both_ways) {
  scene::Scene scene = test::sun_and_mirror(1, Sun::seen_from_earth);
  scene.cameras.front() = {"c", Vec3(.5, .5, .6), Vec3(1, .5, .3), z, scene::Projection(scene::Pinhole{6}), 2, 2};
  const double once = .8 * .5 * .8 * inv_pi, twice = .8 * .5 * .64 * inv_pi;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Estimate found = answer("bidirectional", scene, measure::PixelRadiance{{0}, 0, 0}, 4096, seed, nullptr,
                                  measure::PathClasses::of("FSDSE|FDSE"));
    EXPECT_TRUE(holds(found, once + twice)) << found.value[0] << " +- " << found.standard_error[0];
    EXPECT_GE(found.standard_error[0], .99 * inv_pi);
  }
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
  int missed = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Estimate few = answer("unidirectional", scene, point, 4096, seed);
    EXPECT_TRUE(holds(few, 11)) << few.value[0];
    if (few.value[0] > 5) continue;
    ++missed;
    EXPECT_NEAR(few.value[0], 1, 5e-3) << "the sky alone, but for the last of a thousand paths";
    EXPECT_NEAR(few.standard_error[0], 10, 1e-6);
  }
  EXPECT_GT(missed, 0);
  const Estimate found = answer("unidirectional", scene, point, 0);
  EXPECT_LE(std::abs(found.value[0] - 11), test::critical_z(1e-3, 1) * found.standard_error[0]);
  EXPECT_LE(found.standard_error[0], std::sqrt(2) * target * 11);
}

TEST(RareLight, is_none_without_a_mirror_or_where_it_is_not_asked_for) {
  const scene::Scene scene = test::sun_and_mirror(1, Sun::seen_from_earth);
  EXPECT_FALSE(rare_in(scene).empty());
  EXPECT_TRUE(rare_in(scene, measure::PathClasses::of("L(D|G)*E")).empty());
  EXPECT_TRUE(rare_in(test::sun_and_mirror(1, 0)).empty()) << "is refused instead";
  EXPECT_TRUE(rare_in(test::furnished(1)).empty());
  const RareLights straight = rare_in(scene, measure::PathClasses::of("FSE"));
  EXPECT_GT(straight.lacks(4096, anywhere)[0], 0);
  EXPECT_EQ(straight.lacks(4096, {scene.box(), true})[0], 0) << "what a mirror shows is met by every path of a pixel";
}

}  // namespace
}  // namespace interflect::montecarlo

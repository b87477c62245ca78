#include "montecarlo/controlled/controlled.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>

#include "core/error.h"
#include "fem/radiosity.h"
#include "fem/surface_solution.h"
#include "montecarlo/controlled/controlled_paths.h"
#include "montecarlo/render.h"
#include "tests/montecarlo/rooms.h"

/// Paths with a radiosity solution as their control variate: nothing of its error, and less noise.
namespace interflect {
namespace {

using measure::SurfaceSolution;
using montecarlo::Controlled;
using montecarlo::ControlledSettings;
using montecarlo::PathTracer;
const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();

SurfaceSolution solved(const scene::Scene& scene, double element_size) {
  fem::RadiositySettings settings;
  settings.element_size = element_size;
  settings.rough_is_black = true;
  core::LocalRun run(4, 2);
  const fem::RadiositySolution solution = fem::solve_radiosity(scene, settings, run.get());
  const auto rays = raycast::make_ray_caster("embree", scene);
  return fem::as_surface_solution(solution, fem::mirrored_light(scene, solution, *rays, run.get()));
}

/// One that has other values, cell by cell.
template <class Factor>
SurfaceSolution wrong(const SurfaceSolution& right, const Factor& factor) {
  SurfaceSolution other;
  other.at = [=, of = right.at](const scene::SurfacePoint& at) -> const SurfaceSolution::Known& {
    thread_local SurfaceSolution::Known here;
    here = of(at);
    here.reflected *= factor(here.cell);
    return here;
  };
  return other;
}

/// One that says the same of every point, or of those of one surface alone.
SurfaceSolution same_everywhere(const Spectrum& reflected, std::optional<scene::SurfaceId> only = {}) {
  SurfaceSolution solution;
  SurfaceSolution::Known some;
  some.reflected = reflected;
  solution.at = [=,
                 nothing = SurfaceSolution::Known()](const scene::SurfacePoint& at) -> const SurfaceSolution::Known& {
    return only && at.surface.value != only->value ? nothing : some;
  };
  return solution;
}

/// By so many samples of each.
Controlled by(const SurfaceSolution& solution, std::uint64_t samples) {
  ControlledSettings settings;
  settings.samples = samples;
  settings.solution = solution;
  return Controlled(settings);
}

/// Mean over all that is asked of (standard error / value)², in the scene's weights.
double relative_variance(const measure::Method& method, const scene::Scene& scene,
                         const std::vector<measure::Measurement>& asked) {
  core::LocalRun run(9, 2);
  double sum = 0;
  for (const Estimate& each : method.answer(scene, asked, run.get()))
    sum += std::pow(each.weighed_standard_error / scene.weigh(each.value), 2);
  return sum / static_cast<double>(asked.size());
}

/// A lit room, and a dark one beside it with a door between them that the lamp is not seen through.
scene::Scene two_rooms() {
  scene::SceneBuilder builder({"a", "b"});
  scene::Material wall = test::diffuse("wall", .6, 0), lamp = test::diffuse("lamp", .2, 20);
  wall.reflectance[1] = .4, lamp.reflectance[1] = .1, lamp.exitance[1] = 10;
  wall.sides = scene::Sides::both;
  const auto walls = builder.add_material(wall);
  builder.add_box("rooms", {Vec3::Zero(), Vec3(4, 2, 1)}, walls, scene::SceneBuilder::Facing::inward);
  builder.add_polygon("between", test::parallelogram(Vec3(2, .5, 0), 1.5 * y, z), walls);
  builder.add_polygon("lamp", test::parallelogram(Vec3(.5, 1.4, .95), .4 * y, .5 * x), builder.add_material(lamp));
  builder.scene().cameras.push_back({"c", Vec3(3.8, 1, .6), Vec3(2, 1.2, .4), z, 70, 3, 2});
  return builder.finish();
}
std::vector<measure::Measurement> in_the_dark() {
  return {measure::PointIrradiance{Vec3(3, 1.5, .4), z, {}}, measure::PointIrradiance{Vec3(3.5, .5, .3), -x, {}},
          measure::PixelRadiance{{0}, 0, 0}, measure::PixelRadiance{{0}, 2, 1}};
}

// Whatever the solution says: the right thing, 30 % more or less, or nonsense from element to element.
TEST(Controlled, agrees_with_path_tracing_whatever_the_solution_says) {
  for (const double scale : {1e-6, 1.0, 1e6}) {
    const scene::Scene scene = test::furnished(scale);
    const SurfaceSolution right = solved(scene, .3 * scale);
    const auto asked = test::all_of_furnished(scene, scale);
    const PathTracer paths({.samples = 20'000});
    test::expect_same(by(right, 15'000), paths, scene, asked, .1);
    for (const double factor : {.7, 1.3})
      test::expect_same(by(wrong(right, [=](std::uint32_t) { return factor; }), 15'000), paths, scene, asked, .1);
    const auto nonsense = [](std::uint32_t cell) { return cell % 2 == 0 ? 4.0 : .1; };
    test::expect_same(by(wrong(right, nonsense), 15'000), paths, scene, asked, .2);
  }
}

TEST(Controlled, agrees_with_path_tracing_in_a_room_that_is_lit_by_another) {
  const scene::Scene scene = two_rooms();
  const SurfaceSolution right = solved(scene, .25);
  const PathTracer paths({.samples = 400'000});
  test::expect_same(by(right, 100'000), paths, scene, in_the_dark(), .05);
  test::expect_same(by(wrong(right, [](std::uint32_t) { return 1.3; }), 100'000), paths, scene, in_the_dark(), .05);
}

// Beside mirrors, glass, plastic and nets, of most of which a solution knows nothing, to all cameras.
TEST(Controlled, agrees_with_path_tracing_beside_every_material) {
  const scene::Scene scene = test::shiny();
  Spectrum some = test::grey(2);
  some[1] = 1;
  std::vector<measure::Measurement> asked{
      measure::Flux{measure::patches_of(scene, test::surface_named(scene, "room/z-"), scene::Side::front)},
      measure::PointIrradiance{Vec3(.3, 1, .4), Vec3(.6, 0, .8), {}}};
  for (std::uint32_t c = 0; c < scene.cameras.size(); ++c) asked.push_back(measure::PixelRadiance{{c}, 1, 2});
  test::expect_same(by(same_everywhere(some), 100'000), PathTracer({.samples = 200'000}), scene, asked, .2);
}

/// A room with a mirror for a wall.  One camera looks into it, and one away from it.
scene::Scene with_a_mirror() {
  scene::SceneBuilder builder({"grey"});
  builder.add_box("room", {Vec3::Zero(), Vec3(2, 1.5, 1)}, builder.add_material(test::diffuse("wall", .5, 0)),
                  scene::SceneBuilder::Facing::inward);
  builder.add_polygon("lamp", test::parallelogram(Vec3(.7, .9, .95), .4 * y, .5 * x),
                      builder.add_material(test::diffuse("lamp", .2, 20)));
  scene::Material mirror;
  mirror.name = "mirror", mirror.finish = scene::Mirror{test::grey(.9)}, mirror.sides = scene::Sides::both;
  builder.add_polygon("mirror", test::parallelogram(Vec3(.02, 1.48, .02), 1.96 * x, .96 * z),
                      builder.add_material(mirror));
  builder.scene().cameras.push_back({"into", Vec3(1, .4, .4), Vec3(1, 1.48, .4), z, 60, 2, 1});
  builder.scene().cameras.push_back({"away", Vec3(1, 1.2, .4), Vec3(1, 0, .4), z, 60, 2, 1});
  return builder.finish();
}

// What a solution says of mirrors is nothing to controlled paths: T rho of what is diffuse is zero there.  Where it is
// all that is said, nothing is expected of a wall that is seen first, and no path would go on from the mirror.
TEST(Controlled, goes_on_from_mirrors_whatever_the_solution_says_of_them) {
  const scene::Scene scene = with_a_mirror();
  const std::vector<measure::Measurement> asked{measure::PixelRadiance{{0}, 0, 0}, measure::PixelRadiance{{1}, 1, 0},
                                                measure::PointIrradiance{Vec3(1, .3, .3), y, {}}};
  const PathTracer paths({.samples = 200'000});
  const auto mirror = test::surface_named(scene, "mirror");
  for (const auto& only : {std::optional<scene::SurfaceId>(), std::optional(mirror)})
    test::expect_same(by(same_everywhere(test::grey(2), only), 100'000), paths, scene, asked, .02);
}

// Bit by bit.
TEST(Controlled, has_the_paths_of_path_tracing_where_the_solution_knows_nothing) {
  const scene::Scene scene = test::furnished(1);
  const auto rays = raycast::make_ray_caster("embree", scene);
  const SurfaceSolution nothing = same_everywhere(Spectrum::zero());
  const auto all = measure::PathClasses::all();
  const montecarlo::PathEstimator paths(scene, *rays, all);
  const montecarlo::ControlledPaths controlled(scene, *rays, nothing, all);
  std::vector<std::optional<raycast::Ray>> from_eye;
  for (int k = 0; k < 300; ++k)
    from_eye.push_back(raycast::Ray{Vec3(.3, .4, .5), Vec3(std::cos(.1 * k), std::sin(.1 * k), .3).normalized()});
  const montecarlo::PathEstimator::Keys keys{3, 1, 5};
  std::vector<Spectrum> known(from_eye.size());
  std::vector<montecarlo::ControlledPaths::Found> found(from_eye.size());
  paths.radiance(from_eye, keys, 2, known);
  controlled.radiance(from_eye, keys, 2, found);
  for (std::size_t k = 0; k < found.size(); ++k) {
    EXPECT_TRUE(found[k].control.is_zero());
    for (int c = 0; c < 2; ++c) EXPECT_EQ(found[k].path[c], known[k][c]) << k;
  }
}

TEST(Controlled, counts_what_is_no_number_and_then_claims_nothing) {
  const scene::Scene scene = test::furnished(1);
  montecarlo::SampleReport report;
  ControlledSettings settings;
  settings.samples = 100;
  settings.solution = same_everywhere(test::grey(std::numeric_limits<double>::quiet_NaN()));
  settings.report = &report;
  core::LocalRun run(1, 2);
  const auto found = Controlled(settings).answer(scene, test::all_of_furnished(scene, 1), run.get());
  EXPECT_GT(report.not_finite, 0u);
  for (const Estimate& each : found) {
    EXPECT_EQ(each.claim, Claim::none);
    EXPECT_TRUE(std::isinf(each.error_bound[0]));
  }
}

/// A lit cell, and one beside it that nothing leads into.  A camera below the ceiling sees the floors of both.
scene::Scene lit_and_closed() {
  scene::SceneBuilder builder({"grey"});
  const auto walls = builder.add_material(test::diffuse("wall", .5, 0, scene::Sides::both));
  builder.add_box("cells", {Vec3::Zero(), Vec3(4, 2, 1)}, walls, scene::SceneBuilder::Facing::inward);
  builder.add_polygon("between", test::parallelogram(Vec3(2, -.1, -.1), 2.2 * y, 1.2 * z), walls);
  builder.add_polygon("lamp", test::parallelogram(Vec3(.5, .5, .95), y, x),
                      builder.add_material(test::diffuse("lamp", .2, 5)));
  builder.scene().cameras.push_back(
      {"c", Vec3(2, 1, .9), Vec3(2, 1, 0), y, scene::Projection(scene::Orthographic{1.8}), 8, 4});
  return builder.finish();
}

// Where no path found the lamp a pixel has nothing but -c g, whose noise does not tell of the light that it missed: the
// error is by the rule of three, as path tracing's.
TEST(Controlled, says_of_pixels_that_found_no_light_how_much_they_may_have_missed) {
  const scene::Scene scene = lit_and_closed();
  const auto rays = raycast::make_ray_caster("embree", scene);
  core::LocalRun run(2, 2);
  for (const char* filter : {"box", "mitchell"}) {
    montecarlo::RenderSettings settings;
    settings.filter = filter;
    const auto paths = montecarlo::render(scene, {0}, settings, run.get(), *rays);
    settings.integrator = "controlled";
    settings.solution = same_everywhere(test::grey(.2));
    const auto picture = montecarlo::render(scene, {0}, settings, run.get(), *rays);
    int dark = 0;
    for (int k = 0; k < 32; ++k) {
      if (paths.radiance.at(k % 8, k / 8, 0) != 0) continue;
      ++dark;
      EXPECT_NE(picture.radiance.at(k % 8, k / 8, 0), 0) << k;
      EXPECT_GE(picture.standard_error.at(k % 8, k / 8, 0), paths.standard_error.at(k % 8, k / 8, 0)) << k;
    }
    EXPECT_GE(dark, filter == std::string("box") ? 16 : 8) << filter;
  }
}

// Nothing is left out: a picture keeps no bound on the solution's error.
TEST(Controlled, has_pictures_that_inherit_no_error) {
  const scene::Scene scene = test::furnished(1);
  montecarlo::RenderSettings settings;
  const auto size = montecarlo::render_state_size(scene, {0}, settings);
  settings.integrator = "controlled";
  EXPECT_EQ(montecarlo::render_state_size(scene, {0}, settings), size);
}

TEST(Controlled, takes_no_factor_from_a_pilot_that_lies_far_off) {
  const auto by_pilot = [](double c) {
    core::ControlVariate pilot(0, 3);
    for (int k = 0; k < 10; ++k) pilot.add(c * k, k);
    return montecarlo::control_factor(pilot);
  };
  EXPECT_NEAR(by_pilot(.7), .7, 1e-12);
  EXPECT_EQ(by_pilot(20), 1.5);
  EXPECT_EQ(by_pilot(-3), 0);
}

// The same number of paths knows more; a factor that the whole solution is wrong by costs nothing, since pilots find it,
// and nonsense costs.
TEST(Controlled, has_less_noise_by_what_the_solution_knows) {
  const scene::Scene scene = two_rooms();
  const SurfaceSolution right = solved(scene, .25);
  const auto asked = in_the_dark();
  const double paths = relative_variance(PathTracer({.samples = 100'000}), scene, asked),
               controlled = relative_variance(by(right, 100'000), scene, asked);
  EXPECT_LT(controlled, .6 * paths);
  const auto at = [&](auto factor) { return relative_variance(by(wrong(right, factor), 100'000), scene, asked); };
  EXPECT_NEAR(at([](std::uint32_t) { return 2.0; }) / controlled, 1, .15);
  EXPECT_GT(at([](std::uint32_t cell) { return cell % 2 == 0 ? 4.0 : .1; }), 1.15 * controlled);
}

// Of 200 seeds, 95 % intervals hold the truth (docs/truths.md, V1) in 181 .. 197 with a probability of .995 each, by a
// solution that is wrong everywhere.
TEST(Controlled, holds_the_truth_as_often_as_it_says) {
  const scene::Scene scene = test::facing_squares();
  const std::vector<test::Question> questions{
      test::whole(scene, "upper", .100947189239 / .5),
      test::whole(scene, "lower", .010218055060 / .5),
      test::at_point({.25, .25, 1}, -z, .104998409669 / .5, test::surface_named(scene, "upper")),
      {measure::PixelRadiance{{0}, 0, 0}, test::grey(.100947189239 * inv_pi), "pixel"}};
  std::vector<measure::Measurement> asked;
  for (const test::Question& question : questions) asked.push_back(question.asked);
  ControlledSettings settings;
  settings.solution = same_everywhere(test::grey(.07));
  for (const bool to_target : {false, true}) {
    settings.samples = to_target ? 0 : 1000, settings.target = .05;
    std::vector<int> held(asked.size());
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
      core::LocalRun run(seed, 2);
      const auto found = Controlled(settings).answer(scene, asked, run);
      for (std::size_t m = 0; m < asked.size(); ++m)
        held[m] += std::abs(found[m].value[0] - questions[m].truth[0]) <= normal_95 * found[m].standard_error[0];
    }
    for (std::size_t m = 0; m < asked.size(); ++m) {
      EXPECT_GE(held[m], 181) << questions[m].name << (to_target ? " to a target" : "");
      EXPECT_LE(held[m], 197) << questions[m].name << (to_target ? " to a target" : "");
    }
  }
}

// Few samples, whose pilot is as many: were they the same ones, c would know them, and the mean of
// many runs would be off by more than their noise.
TEST(Controlled, has_no_bias_of_few_samples) {
  const scene::Scene scene = test::facing_squares();
  const std::vector<measure::Measurement> asked{test::whole(scene, "lower", 0).asked};
  const Controlled few = by(same_everywhere(test::grey(.5)), 64);
  core::ScalarMoments means;
  for (std::uint64_t seed = 1; seed <= 5'000; ++seed) {
    core::LocalRun run(seed, 1);
    means.add(few.answer(scene, asked, run)[0].value[0]);
  }
  EXPECT_NEAR(means.mean(), .010218055060 / .5, test::critical_z(test::alpha, 1) * means.standard_error());
}

// The same paths bit by bit, c and F too.
TEST(Controlled, has_fluxes_that_are_irradiances_times_their_areas) {
  const scene::Scene scene = test::furnished(1);
  const SurfaceSolution solution = solved(scene, .5);
  const auto patches = measure::patches_of(scene, test::surface_named(scene, "floor"), scene::Side::front);
  core::LocalRun run(7, 1);
  const auto of = [&](const measure::Measurement& asked) {
    return by(solution, 1'000).answer(scene, {&asked, 1}, run.get())[0].value[0];
  };
  EXPECT_NEAR(of(measure::Flux{{patches[0]}}) / (patches[0].area * of(measure::PatchIrradiance{patches[0]})), 1, 1e-9);
}

TEST(Controlled, has_the_same_bits_for_any_number_of_threads) {
  const scene::Scene scene = test::furnished(1);
  const SurfaceSolution solution = solved(scene, .5);
  const auto with = [&](unsigned threads) {
    core::LocalRun run(7, threads);
    std::vector<double> bits;
    for (const Estimate& each : by(solution, 1'000).answer(scene, test::all_of_furnished(scene, 1), run.get()))
      for (int c = 0; c < 2; ++c) bits.insert(bits.end(), {each.value[c], each.standard_error[c]});
    return bits;
  };
  const auto one = with(1);
  for (const unsigned threads : {2u, 3u, 8u}) EXPECT_EQ(with(threads), one) << threads;
}

// Pixels of a picture are the answers; by a filter with negative lobes it goes on after a stop to the same bits.
TEST(Controlled, makes_pictures_of_its_pixels) {
  const scene::Scene scene = test::furnished(1);
  const auto rays = raycast::make_ray_caster("embree", scene);
  montecarlo::RenderSettings settings;
  settings.integrator = "controlled";
  settings.samples = 10'000;
  settings.solution = wrong(solved(scene, .3), [](std::uint32_t) { return 1.3; });
  core::LocalRun run(5, 2);
  const auto picture = montecarlo::render(scene, {0}, settings, run.get(), *rays);
  std::vector<measure::Measurement> pixels;
  for (int k = 0; k < 24; ++k) pixels.emplace_back(measure::PixelRadiance{{0}, k % 6, k / 6});
  const auto known = PathTracer({.samples = 20'000}).answer(scene, pixels, run.get());
  const double limit = test::critical_z(test::alpha, 48);
  for (int k = 0; k < 24; ++k)
    for (int c = 0; c < 2; ++c) {
      const Estimate& pixel = known[static_cast<std::size_t>(k)];
      const double error = picture.standard_error.at(k % 6, k / 6, c);
      EXPECT_NEAR(picture.radiance.at(k % 6, k / 6, c), pixel.value[c],
                  limit * std::hypot(error, pixel.standard_error[c]))
          << k;
      EXPECT_LT(error, .1 * pixel.value[c]);
    }
  settings.filter = "mitchell", settings.samples = 64;
  const auto whole = montecarlo::render(scene, {0}, settings, run.get(), *rays);
  montecarlo::FilmState state;
  montecarlo::RenderCheckpoints keep, from;
  keep.seconds_between = 0;
  keep.keep = [&](const montecarlo::FilmState& now) { state = now; };
  settings.samples = 20;
  montecarlo::render(scene, {0}, settings, run.get(), *rays, keep);
  settings.samples = 64;
  from.from = &state;
  EXPECT_EQ(montecarlo::render(scene, {0}, settings, run.get(), *rays, from).radiance.data, whole.radiance.data);
}

TEST(Controlled, needs_a_solution) {
  const scene::Scene scene = test::furnished(1);
  core::LocalRun run(1, 1);
  ControlledSettings settings;
  settings.solution.why_none = "none is known";
  try {
    Controlled(settings).answer(scene, test::all_of_furnished(scene, 1), run.get());
    FAIL() << "refusal expected";
  } catch (const core::InputError& error) {
    EXPECT_STREQ(error.what(), "none is known");
  }
}

}  // namespace
}  // namespace interflect

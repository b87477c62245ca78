#include "core/error.h"
#include "montecarlo/integrators.h"
#include "montecarlo/path_tracer.h"
#include "tests/montecarlo/rooms.h"
#include "tests/montecarlo/statistics.h"

// Paths that meet lights by chance alone, at weight 1: nothing of lights' densities, weights or shadow rays is in them.
namespace interflect::montecarlo {
namespace {

PathTracer unidirectional(std::uint64_t samples, const measure::PathClasses& paths = measure::PathClasses::all()) {
  PathTracerSettings settings;
  settings.samples = samples, settings.paths = paths, settings.next_event = NextEvent::no;
  return PathTracer(settings);
}

TEST(Unidirectional, agrees_with_next_event_estimation_at_every_scale) {
  for (const double scale : {1e-6, 1., 1e6}) {
    const scene::Scene scene = test::furnished(scale);
    test::expect_same(unidirectional(30'000), PathTracer({.samples = 10'000}), scene,
                      test::all_of_furnished(scene, scale), .2);
  }
}

TEST(Unidirectional, agrees_beside_every_material) {
  const scene::Scene scene = test::shiny();
  std::vector<measure::Measurement> asked{
      measure::Flux{measure::patches_of(scene, test::surface_named(scene, "room/z-"), scene::Side::front)},
      measure::PointIrradiance{Vec3(.3, 1, .4), Vec3(.6, 0, .8), {}}};
  for (std::uint32_t c = 0; c < scene.cameras.size(); ++c) asked.push_back(measure::PixelRadiance{{c}, 1, 2});
  test::expect_same(unidirectional(100'000), PathTracer({.samples = 100'000}), scene, asked, .3);
}

// In a furnace every way leads to what shines: rho = .5 everywhere, E = 1, H = 2.
TEST(Unidirectional, knows_a_furnace) {
  scene::SceneBuilder builder({"grey"});
  builder.add_box("room", {Vec3::Zero(), Vec3(3, 2, 1)}, builder.add_material(test::diffuse("wall", .5, 1)),
                  scene::SceneBuilder::Facing::inward);
  const scene::Scene scene = builder.finish();
  core::LocalRun run(3, 2);
  std::vector<measure::Measurement> asked;
  for (const scene::SurfaceId id : scene.surface_ids())
    asked.push_back(measure::Flux{measure::patches_of(scene, id, scene::Side::front)});
  const auto found = unidirectional(10'000).answer(scene, asked, run.get());
  const double z = test::critical_z(1e-3, found.size());
  for (std::size_t m = 0; m < found.size(); ++m) {
    const double truth = 2 * scene.area({static_cast<std::uint32_t>(m)});
    EXPECT_LE(std::abs(found[m].value[0] - truth), z * found[m].standard_error[0] + 1e-9 * truth) << m;
    EXPECT_LE(found[m].standard_error[0], .01 * truth);
  }
}

// What it finds is all of what rays can find, and nothing of points.
TEST(Unidirectional, refuses_points_and_is_named_so) {
  EXPECT_EQ(unidirectional(2).name(), "unidirectional");
  scene::SceneBuilder builder({"grey"});
  builder.add_polygon("floor", test::parallelogram(Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY()),
                      builder.add_material(test::diffuse("grey", .5, 0)));
  builder.scene().lights.points.push_back({"p", Vec3(.5, .5, .5), test::grey(1)});
  builder.scene().cameras.push_back({"c", Vec3(.5, .5, 1), Vec3(.5, .5, 0), Vec3::UnitX(), 40, 1, 1});
  const scene::Scene scene = builder.finish();
  core::LocalRun run(1);
  const auto floor = measure::patches_of(scene, test::surface_named(scene, "floor"), scene::Side::front);
  const std::vector<measure::Measurement> all{measure::Flux{floor},
                                              measure::PointIrradiance{Vec3(.5, .5, .1), Vec3::UnitZ(), {}},
                                              measure::PixelRadiance{{0}, 0, 0}};
  for (const measure::Measurement& each : all)
    EXPECT_THROW(make_integrator("unidirectional", {})->answer(scene, {&each, 1}, run.get()), core::InputError);
}

}  // namespace
}  // namespace interflect::montecarlo

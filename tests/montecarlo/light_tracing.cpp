#include "montecarlo/light_tracer.h"
#include "tests/montecarlo/rooms.h"
#include "tests/montecarlo/statistics.h"
#include "tests/support/shapes.h"

// Paths from lights, against closed forms and against paths from the eye.
namespace interflect::montecarlo {
namespace {

using scene::SceneBuilder;
using test::at_point;
using test::expect_agreement;
using test::furnished;
using test::parallelogram;
using test::Question;
using test::whole;

const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();

void expect_same(const scene::Scene& scene, const std::vector<measure::Measurement>& asked, std::uint64_t paths,
                 std::uint64_t samples, double largest_error) {
  test::expect_same(LightTracer({.samples = paths}), PathTracer({.samples = samples}), scene, asked, largest_error);
}

TEST(LightTracer, agrees_with_paths_from_the_eye_on_all_that_can_be_asked) {
  for (const double scale : {1e-6, 1.0, 1e6}) {
    const scene::Scene scene = furnished(scale);
    const auto asked = test::all_of_furnished(scene, scale);
    expect_same(scene, asked, scale == 1 ? 400'000 : 100'000, scale == 1 ? 40'000 : 20'000, scale == 1 ? .1 : .2);
  }
}

// All that is emitted arrives somewhere, once: in a closed black room the fluxes of all walls add up to what the lamp
// emits in every path, to rounding.
TEST(LightTracer, loses_nothing_of_what_is_emitted) {
  SceneBuilder builder({"grey"});
  const auto wall = builder.add_material(test::diffuse("wall", 0, 0)),
             lamp = builder.add_material(test::diffuse("lamp", 0, 7));
  builder.add_box("room", {Vec3(0, 0, 0), Vec3(3, 2, 1)}, wall, SceneBuilder::Facing::inward);
  builder.add_box("lamp", {Vec3(1, .5, .2), Vec3(1.2, .7, .9)}, lamp);
  const scene::Scene scene = builder.finish();
  core::LocalRun run(1);
  const std::vector<measure::Measurement> asked{test::all_fronts(scene)};
  const Estimate all = LightTracer({.samples = 20'000}).answer(scene, asked, run.get())[0];
  EXPECT_NEAR(all.value[0], scene.emitted_flux()[0], 1e-12 * all.value[0]);
  EXPECT_LT(all.standard_error[0], 1e-12 * all.value[0]);
}

// The same of lights that are no surfaces: every particle weighs as much as any other, and none is lost.
TEST(LightTracer, loses_nothing_of_points_spots_and_balls) {
  for (const double scale : {1e-6, 1.0, 1e6})
    for (const int kind : {0, 1, 2}) {
      SceneBuilder builder({"grey"});
      builder.add_box("room", {Vec3(0, 0, 0), scale * Vec3(3, 2, 1)}, builder.add_material(test::diffuse("wall", 0, 0)),
                      SceneBuilder::Facing::inward);
      scene::Lights& lights = builder.scene().lights;
      if (kind == 0) lights.points.push_back({"p", scale * Vec3(1, .7, .4), test::grey(3)});
      if (kind == 1) lights.spots.push_back({"s", scale * Vec3(2, .7, .4), Vec3(.6, 0, .8), test::grey(3), .9, .7});
      if (kind == 2) lights.spheres.push_back({"b", scale * Vec3(1.3, 1.1, .6), .2 * scale, test::grey(3)});
      const scene::Scene scene = builder.finish();
      core::LocalRun run(1);
      const std::vector<measure::Measurement> asked{test::all_fronts(scene)};
      const Estimate all = LightTracer({.samples = 20'000}).answer(scene, asked, run.get())[0];
      const double flux = kind == 0   ? scene.lights.points[0].flux()[0]
                          : kind == 1 ? scene.lights.spots[0].flux()[0]
                                      : scene.lights.spheres[0].flux()[0];
      EXPECT_NEAR(all.value[0], flux, 1e-10 * flux) << scale << ", kind " << kind;
    }
}

// And of all of them together, with the sun and a sky that come in where the ceiling is open.
TEST(LightTracer, agrees_with_paths_from_the_eye_on_every_kind_of_light) {
  const scene::Scene scene = test::lit_by_all();
  const auto asked = test::all_of_lit(scene);
  expect_same(scene, asked, 400'000, 100'000, .05);
}

// A surface that nothing reaches is known to be dark after a while, and keeps nobody waiting.
TEST(LightTracer, knows_what_is_dark) {
  SceneBuilder builder({"grey"});
  const auto wall = builder.add_material(test::diffuse("wall", .4, 0)),
             lamp = builder.add_material(test::diffuse("lamp", 0, 7));
  builder.add_box("room", {Vec3(0, 0, 0), Vec3(1, 1, 1)}, wall, SceneBuilder::Facing::inward);
  builder.add_box("lamp", {Vec3(.4, .4, .4), Vec3(.6, .6, .6)}, lamp);
  builder.add_box("next door", {Vec3(2, 0, 0), Vec3(3, 1, 1)}, wall, SceneBuilder::Facing::inward);
  const scene::Scene scene = builder.finish();
  const std::vector<measure::Measurement> asked{
      measure::Flux{measure::patches_of(scene, test::surface_named(scene, "room/z-"), scene::Side::front)},
      measure::Flux{measure::patches_of(scene, test::surface_named(scene, "next door/z-"), scene::Side::front)}};
  core::LocalRun run(1);
  const auto found = LightTracer({.target = .05}).answer(scene, asked, run.get());
  EXPECT_EQ(found[1].value[0], 0);
  EXPECT_GT(found[1].standard_error[0], 0);
  EXPECT_LT(found[0].samples, 1U << 22);
}

// A furnace's walls and pixels, every corner of a picture of 90 degrees: one cosine less would make the corners
// darker by .58.
TEST(LightTracer, sees_a_furnace_everywhere) {
  SceneBuilder builder({"grey"});
  const auto wall = builder.add_material(test::diffuse("wall", .6, .4));
  builder.add_box("room", {Vec3(0, 0, 0), Vec3(2, 3, 1)}, wall, SceneBuilder::Facing::inward);
  builder.scene().cameras.push_back({"c", Vec3(.9, 1.2, .4), Vec3(1.5, 2.8, .7), Vec3(.3, .1, 1), 90, 3, 3});
  const scene::Scene scene = builder.finish();
  std::vector<Question> questions;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) questions.push_back({measure::PixelRadiance{{0}, a, b}, test::grey(inv_pi), "pixel"});
  questions.push_back(at_point(Vec3(1, 1, .5), Vec3(0, .6, .8), 1));
  for (const scene::SurfaceId id : scene.surface_ids()) questions.push_back(whole(scene, scene.surface(id).name, 1));
  expect_agreement(LightTracer({.samples = 400'000}), scene, questions, .02);
}

// Only paths from lights find what a mirror throws onto a ceiling soon; what they hit they find whatever is between.
TEST(LightTracer, follows_light_through_mirrors_and_glass) {
  SceneBuilder builder({"grey"});
  const auto of = [&](scene::Finish finish) {
    scene::Material material;
    material.finish = std::move(finish);
    material.sides = scene::Sides::both;
    return builder.add_material(material);
  };
  builder.add_polygon("light", parallelogram(z, y, x), builder.add_material(test::diffuse("l", 0, 1)));
  builder.add_polygon("beside", parallelogram(z + x, y, x), builder.add_material(test::diffuse("b", 0, 0)));
  builder.add_polygon("aslant", parallelogram(z + x + y, y, x), builder.add_material(test::diffuse("a", 0, 0)));
  builder.add_polygon("mirror", parallelogram(-20 * (x + y), 40 * x, 40 * y), of(scene::Mirror{test::grey(.8)}));
  const scene::Scene scene = builder.finish();
  expect_agreement(LightTracer({.samples = 400'000}), scene,
                   {whole(scene, "beside", .8 * .0480641029851), whole(scene, "aslant", .8 * .0351071009097)}, .02);
  core::LocalRun run(1);
  const std::vector<measure::Measurement> point{measure::PointIrradiance{Vec3(1, 1, .5), z, {}}};
  EXPECT_THROW(LightTracer({.samples = 100}).answer(scene, point, run.get()), core::InputError);
}

TEST(LightTracer, stops_where_all_are_known_as_well_as_is_asked_for) {
  const scene::Scene scene = furnished(1);
  std::vector<measure::Measurement> asked;
  for (const scene::SurfaceId id : scene.surface_ids())
    asked.push_back(measure::Flux{measure::patches_of(scene, id, scene::Side::front)});
  core::LocalRun run(5);
  const auto found = LightTracer({.target = .02}).answer(scene, asked, run.get());
  for (const Estimate& each : found) EXPECT_LT(each.weighed_standard_error, .02 * scene.weigh(each.value));
  EXPECT_LT(found[0].samples, 1U << 22);  // of the 2^28 that there could be
}

// Cameras of every kind, and what lets light pass on the way to them and to points: a net, and rough glass.
TEST(LightTracer, agrees_with_paths_from_the_eye_through_nets_and_every_camera) {
  SceneBuilder builder({"a"});
  const auto wall = builder.add_material(test::diffuse("wall", .5, 0));
  builder.add_box("room", {Vec3(0, 0, 0), Vec3(3, 2, 1)}, wall, SceneBuilder::Facing::inward);
  builder.add_polygon("lamp", parallelogram(Vec3(1.2, .6, .95), .8 * y, .9 * x),
                      builder.add_material(test::diffuse("lamp", 0, 5)));
  scene::Material net = test::diffuse("net", .3, 0, scene::Sides::both);
  net.opacity = .4;
  builder.add_polygon("net", parallelogram(Vec3(.8, 0, 0), 2 * y, z), builder.add_material(net));
  scene::Material frosted;
  frosted.finish = scene::Glass{1.5, .4};
  frosted.sides = scene::Sides::both;
  builder.add_box("block", {Vec3(2, .7, .2), Vec3(2.5, 1.2, .6)}, builder.add_material(frosted));
  std::vector<measure::Measurement> asked{measure::PointIrradiance{Vec3(.3, 1, .4), Vec3(.6, 0, .8), {}},
                                          measure::PointIrradiance{Vec3(2.2, 1, .05), z, {}}};
  for (const scene::Projection& projection :
       {scene::Projection(scene::Pinhole{80}), scene::Projection(scene::ThinLens{80, .05, 1}),
        scene::Projection(scene::Orthographic{.5}), scene::Projection(scene::Panoramic{}),
        scene::Projection(scene::Fisheye{})}) {
    const auto camera = static_cast<std::uint32_t>(builder.scene().cameras.size());
    builder.scene().cameras.push_back(
        {"c" + std::to_string(camera), Vec3(.2, .9, .5), Vec3(2.2, 1, .35), z, projection, 3, 3});
    asked.push_back(measure::PixelRadiance{{camera}, 1, 1});
    asked.push_back(measure::PixelRadiance{{camera}, 2, 1});
  }
  const scene::Scene scene = builder.finish();
  expect_same(scene, asked, 1'000'000, 60'000, .2);
}

}  // namespace
}  // namespace interflect::montecarlo

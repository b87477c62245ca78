#include "montecarlo/light_tracer.h"
#include "tests/montecarlo/statistics.h"
#include "tests/support/shapes.h"

// Paths from lights, against closed forms and against paths from the eye.
namespace interflect::montecarlo {
namespace {

using scene::SceneBuilder;
using test::at_point;
using test::expect_agreement;
using test::Question;
using test::whole;

const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();

geometry::PlanarPolygon parallelogram(const Vec3& corner, const Vec3& u, const Vec3& v) {
  return {{corner, corner + u, corner + u + v, corner + v}, {}};
}

/// A room that is not convex, of three reflectances, with a block that hides and a lamp.
scene::Scene furnished(double scale) {
  SceneBuilder builder({"a", "b"});
  const auto of = [&](double a, double b, double lamp = 0) {
    scene::Material material = test::diffuse("m", a, lamp);
    material.reflectance[1] = b, material.exitance[1] = 2 * lamp;
    return builder.add_material(material);
  };
  const auto grey = of(.5, .3), bright = of(.8, .7), dark = of(.1, .2), lamp = of(.2, .6, 5);
  const auto add = [&](const char* name, const Vec3& corner, const Vec3& u, const Vec3& v, scene::MaterialId material) {
    builder.add_polygon(name, parallelogram(scale * corner, scale * u, scale * v), material);
  };
  add("floor", Vec3::Zero(), 3 * x, 2 * y, grey);
  add("ceiling", z, 2 * y, 3 * x, bright);
  add("south", Vec3::Zero(), z, 3 * x, dark);
  add("north", 2 * y, 3 * x, z, grey);
  add("west", Vec3::Zero(), 2 * y, z, bright);
  add("east", 3 * x, z, 2 * y, dark);
  builder.add_box("block", geometry::Box(scale * Vec3(1, .6, .1), scale * Vec3(1.6, 1.1, .5)), grey);
  add("lamp", Vec3(2, .5, .95), .4 * y, .5 * x, lamp);
  builder.scene().cameras.push_back({"c", scale * Vec3(.1, .1, .6), scale * Vec3(2, 1.5, .3), z, 70, 6, 4});
  return builder.finish();
}

/// Patches, flux, points in the air and on walls, and pixels, with what one method finds as the truth of the other.
void expect_same(const scene::Scene& scene, const std::vector<measure::Measurement>& asked, std::uint64_t paths,
                 std::uint64_t samples, double largest_error) {
  core::LocalRun run(3);
  const auto eye = PathTracer({.samples = samples}).answer(scene, asked, run.get()),
             light = LightTracer({.paths = paths}).answer(scene, asked, run.get());
  const double limit = test::critical_z(test::alpha, asked.size() * static_cast<std::size_t>(scene.channel_count()));
  for (std::size_t m = 0; m < asked.size(); ++m)
    for (int c = 0; c < scene.channel_count(); ++c) {
      const double error = std::hypot(eye[m].standard_error[c], light[m].standard_error[c]);
      EXPECT_NEAR(light[m].value[c], eye[m].value[c], limit * error) << m << ", channel " << c;
      EXPECT_LT(light[m].standard_error[c], largest_error * eye[m].value[c]) << m << ", channel " << c;
    }
}

TEST(LightTracer, agrees_with_paths_from_the_eye_on_all_that_can_be_asked) {
  for (const double scale : {1e-6, 1.0, 1e6}) {
    const scene::Scene scene = furnished(scale);
    std::vector<measure::Measurement> asked;
    for (const scene::SurfaceId id : scene.surface_ids()) {
      const auto patches = measure::patches_of(scene, id, scene::Side::front);
      asked.push_back(measure::PatchIrradiance{patches[0]});
      asked.push_back(measure::Flux{patches});
    }
    asked.push_back(test::all_fronts(scene));
    asked.push_back(measure::PointIrradiance{scale * Vec3(.5, 1, .4), Vec3(.6, 0, .8), {}});
    asked.push_back(measure::PointIrradiance{scale * Vec3(2, 1, 0), z, test::surface_named(scene, "floor")});
    for (int k = 0; k < 4; ++k) asked.push_back(measure::PixelRadiance{{0}, k + 1, k});
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
  const Estimate all = LightTracer({.paths = 20'000}).answer(scene, asked, run.get())[0];
  EXPECT_NEAR(all.value[0], scene.emitted_flux()[0], 1e-12 * all.value[0]);
  EXPECT_LT(all.standard_error[0], 1e-12 * all.value[0]);
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
  expect_agreement(LightTracer({.paths = 400'000}), scene, questions, .02);
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
  expect_agreement(LightTracer({.paths = 400'000}), scene,
                   {whole(scene, "beside", .8 * .0480641029851), whole(scene, "aslant", .8 * .0351071009097)}, .02);
  core::LocalRun run(1);
  const std::vector<measure::Measurement> point{measure::PointIrradiance{Vec3(1, 1, .5), z, {}}};
  EXPECT_THROW(LightTracer({.paths = 100}).answer(scene, point, run.get()), core::InputError);
}

TEST(LightTracer, stops_where_all_are_known_as_well_as_is_asked_for) {
  const scene::Scene scene = furnished(1);
  std::vector<measure::Measurement> asked;
  for (const scene::SurfaceId id : scene.surface_ids())
    asked.push_back(measure::Flux{measure::patches_of(scene, id, scene::Side::front)});
  core::LocalRun run(5);
  const auto found = LightTracer({.target = .02}).answer(scene, asked, run.get());
  for (const Estimate& each : found) EXPECT_LT(each.weighed_standard_error, .02 * scene.weigh(each.value));
  EXPECT_EQ(found[0].samples & (found[0].samples - 1), 0);  // rounds double
}

TEST(LightTracer, has_the_same_bits_for_any_number_of_threads) {
  const scene::Scene scene = furnished(1);
  const std::vector<measure::Measurement> asked{
      measure::Flux{measure::patches_of(scene, test::surface_named(scene, "floor"), scene::Side::front)},
      measure::PointIrradiance{Vec3(.5, 1, .4), z, {}}, measure::PixelRadiance{{0}, 2, 2},
      measure::PixelRadiance{{0}, 2, 2}};
  std::vector<std::vector<Estimate>> found;
  for (const unsigned threads : {1u, 2u, 3u, 8u}) {
    core::LocalRun run(7, threads);
    found.push_back(LightTracer({.paths = 30'000}).answer(scene, asked, run.get()));
  }
  for (const auto& each : found)
    for (std::size_t m = 0; m < asked.size(); ++m) {
      EXPECT_EQ(each[m].value, found[0][m].value);
      EXPECT_EQ(each[m].standard_error, found[0][m].standard_error);
    }
  EXPECT_EQ(found[0][2].value, found[0][3].value);  // asked twice
}

}  // namespace
}  // namespace interflect::montecarlo

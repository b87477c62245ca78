#include "tests/montecarlo/known_rooms.h"
#include "tests/montecarlo/statistics.h"
#include "tests/support/shapes.h"

// Closed rooms: what is emitted is absorbed.  Truths: docs/truths.md 2.0, 2.1, 2.6, or derived beside the test or the
// scene.
namespace interflect::montecarlo {
namespace {

using scene::SceneBuilder;
using test::expect_agreement;
using test::grey;
using test::Question;

/// Every facet, all of them together, a point in the air for some hemispheres, and some pixels, of a room with
/// irradiance H.
std::vector<Question> everything(const scene::Scene& scene, const Spectrum& H, const Spectrum& B) {
  std::vector<Question> questions;
  for (const scene::SurfaceId id : scene.surface_ids())
    for (const auto& patch : measure::patches_of(scene, id, scene::Side::front))
      questions.push_back({measure::PatchIrradiance{patch}, H, scene.surface(id).name});
  double area = 0;
  for (const scene::Facet& facet : scene.facets) area += facet.area;
  questions.push_back({test::all_fronts(scene), area * H, "all"});
  const Vec3 middle = scene.cameras[0].eye;
  for (const Vec3& n : {Vec3(Vec3::UnitX()), Vec3(0, -0.6, 0.8), Vec3(-Vec3::UnitZ())})
    questions.push_back({measure::PointIrradiance{middle, n, {}}, H, "point"});
  const scene::Facet& facet = scene.facets.front();
  questions.push_back(
      {measure::PointIrradiance{(facet.corner[0] + facet.corner[1] + facet.corner[2]) / 3, facet.normal, facet.surface},
       H, "on"});
  for (int x : {0, 5}) questions.push_back({measure::PixelRadiance{{0}, x, 3}, B * inv_pi, "pixel"});
  return questions;
}

// Furnace: E = 1 - rho on all walls gives B = 1 = H.  Four reflectances in four channels on the same paths: the
// contributions of paths of k scatterings are (1 - rho) rho^k, and a sum that is right at four reflectances has them
// right one by one (a missing length doubled elsewhere would show).
TEST(PathTracer, finds_radiosity_one_in_a_furnace_of_any_reflectance) {
  const scene::Material wall = test::furnace_wall(std::array{0.2, 0.5, 0.8, 0.95});
  const scene::Scene scene = test::random_room(wall, {"a", "b", "c", "d"}, {});
  expect_agreement(scene, everything(scene, Spectrum(1), Spectrum(1)), {.samples = 8192}, 0.03);
}

// The same with one channel, whose own reflectance then rules the roulette, by both intersectors, at all scales and
// places.
TEST(PathTracer, finds_radiosity_one_in_a_furnace_at_every_scale_and_place) {
  for (const auto& placing : test::placings)
    for (double rho : {0.2, 0.8}) {
      const scene::Scene scene = test::random_room(test::diffuse("grey", rho, 1 - rho), {"grey"}, placing);
      expect_agreement(scene, everything(scene, grey(1), grey(1)), {.samples = 4096}, 0.05);
      expect_agreement(scene, everything(scene, grey(1), grey(1)), {.samples = 512, .intersector = "brute"}, 0.15);
    }
}

// In a closed room of one reflectance all that is emitted is absorbed: (1 - rho) sum A H = sum A E, whatever its shape
// and wherever the lamp.  The lamp is 1/26 000 of the walls.
TEST(PathTracer, finds_all_that_is_emitted_absorbed_by_the_walls_of_a_closed_room) {
  for (const char* intersector : {"embree", "brute"}) {
    SceneBuilder builder({"grey"});
    const auto wall = builder.add_material(test::diffuse("wall", 0.6, 0)),
               lamp = builder.add_material(test::diffuse("lamp", 0.6, 50));
    builder.add_box("room", {Vec3(0, 0, 0), Vec3(10, 10, 3)}, wall, SceneBuilder::Facing::inward);
    builder.add_box("lamp", {Vec3(3, 4, 2), Vec3(3.05, 4.05, 2.03)}, lamp);
    builder.add_box("shelf", {Vec3(6, 6, 0), Vec3(7, 7, 2.5)}, wall);
    const scene::Scene scene = builder.finish();
    const double flux = scene.emitted_flux()[0];
    EXPECT_NEAR(flux, 50 * (2 * 0.05 * 0.05 + 4 * 0.05 * 0.03), 1e-12);
    expect_agreement(scene, {{test::all_fronts(scene), grey(flux / 0.4), "all"}},
                     {.samples = 40'000, .intersector = intersector}, 0.03);
  }
}

// 2.1.  Facets with chords of length h see each other as the sphere's caps would up to O(h²): at level 3, h = 0.15,
// 0.15² = 0.02 is allowed of one alone.
TEST(PathTracer, finds_a_uniform_irradiance_in_a_sphere_of_any_emission) {
  test::KnownScene sphere = test::sphere_of_varying_emission();
  for (std::uint32_t s = 0; s < sphere.scene.surfaces.size(); s += 320) {
    const auto patches = measure::patches_of(sphere.scene, scene::SurfaceId{s}, scene::Side::front);
    sphere.questions.push_back({measure::PatchIrradiance{patches[0]}, grey(2), sphere.scene.surfaces[s].name, 0.04});
    sphere.questions.push_back(test::mirrored_pair(sphere.scene, scene::SurfaceId{s}));
  }
  expect_agreement(sphere.scene, sphere.questions, {.samples = 40'000}, 0.01);
}

TEST(PathTracer, finds_the_irradiance_of_a_cube_with_one_emitting_face) {
  for (const double rho : {0.5, 0.8}) {
    const test::KnownScene cube = test::cube_with_one_emitting_face(rho);
    expect_agreement(cube.scene, cube.questions, {.samples = 400'000}, 0.01);
  }
}

// The same by walks from the lights, and from both ends.  A pair of facets gets a 640th of all paths.
TEST(WalksFromLights, find_a_uniform_irradiance_in_a_sphere_of_any_emission) {
  test::KnownScene sphere = test::sphere_of_varying_emission();
  for (const std::uint32_t s : {0u, 480u}) {
    sphere.questions.push_back(test::mirrored_pair(sphere.scene, scene::SurfaceId{s}));
  }
  test::expect_found_by("bidirectional", 20'000, sphere, 0.02);
  test::expect_found_by("light", 200'000, sphere, 0.06);
}

TEST(WalksFromLights, find_the_irradiance_of_a_cube_with_one_emitting_face) {
  for (const double rho : {0.5, 0.8}) {
    const test::KnownScene cube = test::cube_with_one_emitting_face(rho);
    test::expect_found_by("bidirectional", 40'000, cube, 0.01);
    test::expect_found_by("light", 80'000, cube, 0.02);
  }
}

}  // namespace
}  // namespace interflect::montecarlo

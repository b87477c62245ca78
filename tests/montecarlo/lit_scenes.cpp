#include "tests/montecarlo/statistics.h"
#include "tests/support/shapes.h"

// Scenes lit by points, spots, balls, suns and skies, against closed forms.
namespace interflect::montecarlo {
namespace {

using scene::SceneBuilder;
using test::at_point;
using test::expect_agreement;
using test::grey;
using test::Question;
using test::whole;

const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();

/// A scene with a black square of this half side far below, out of the way: a scene has a surface.
SceneBuilder with_square(double half, double height, double reflectance, double scale = 1) {
  SceneBuilder builder({"grey"});
  const double a = half * scale, h = height * scale;
  builder.add_polygon("square", {{Vec3(-a, -a, h), Vec3(a, -a, h), Vec3(a, a, h), Vec3(-a, a, h)}, {}},
                      builder.add_material(test::diffuse("m", reflectance, 0)));
  return builder;
}

Vec3 tilted(double degrees) { return {std::sin(degrees * pi / 180), 0, std::cos(degrees * pi / 180)}; }

// A ball whose radius is half its distance, over receivers that are tilted away from it, its horizon cut off at last.
TEST(Balls, light_what_is_tilted_away_from_them) {
  const struct {
    double tilt, F;
  } known[] = {{0, .25},
               {45, .176776695297},
               {60, .125},
               {70, .087654603349},
               {80, .0546958164455},
               {90, .0288344428112},
               {100, .0112837720288},
               {110, .00214956751761}};
  for (const double scale : {1., 1e-6, 1e6}) {
    SceneBuilder builder = with_square(1, -2, 0, scale);
    builder.scene().lights.spheres.push_back({"ball", scale * z, .5 * scale, grey(3)});
    const scene::Scene scene = builder.finish();
    std::vector<Question> questions;
    for (const auto& [tilt, F] : known) questions.push_back(at_point(Vec3::Zero(), tilted(tilt), 3 * F));
    expect_agreement(scene, questions, {.samples = 200'000}, .02);
  }
}

// A ball is a body: it hides what lies behind it, is seen, and what lies within it is dark.
TEST(Balls, stand_in_the_way_and_are_seen) {
  SceneBuilder builder = with_square(3, -1, 0);
  builder.scene().lights.spheres.push_back({"dark", z, .5, grey(0)});
  builder.scene().lights.points.push_back({"p", 2 * z, grey(8)});
  builder.scene().lights.spheres.push_back({"bright", Vec3(0, 0, 30), 1, grey(4)});
  builder.scene().cameras.push_back({"c", Vec3(0, -20, 30), Vec3(0, 0, 30), z, 1, 1, 1});
  const scene::Scene scene = builder.finish();
  // The point by cos / r², the bright ball by E R² cos / d².
  const double aside = 8 / 8. * 2 / std::sqrt(8.) + 4 / 904. * 30 / std::sqrt(904.);
  expect_agreement(scene,
                   {at_point(Vec3::Zero(), z, 0, {}),
                    at_point(Vec3(2, 0, 0), z, aside, {}),
                    at_point(z, z, 0, {}),
                    {measure::PixelRadiance{{0}, 0, 0}, grey(4 * inv_pi), "pixel"}},
                   {.samples = 20'000}, .03);
}

// A point that shines downwards alone, over an endless floor, and a receiver above it that faces down.
TEST(Spots, light_a_receiver_by_way_of_a_floor) {
  const struct { double h, H, of_rho_I; } known[] = {{1, 1, .4}, {.5, 1, .77546779691695}, {1, 2, .19386694922924}};
  for (const double scale : {1., 1e-6, 1e6})
    for (const auto& [h, H, of_rho_I] : known) {
      SceneBuilder builder = with_square(300, 0, .8, scale);
      builder.scene().lights.spots.push_back({"half", scale * h * z, -z, grey(5), 1e-12, 0});
      const scene::Scene scene = builder.finish();
      expect_agreement(scene, {at_point(scale * H * z, -z, .8 * 5 * of_rho_I / scale / scale)}, {.samples = 200'000},
                       .01);
    }
}

// The same of a point, whose light a receiver that faces up does not see; and what it sends straight on.
TEST(Points, light_by_the_inverse_square) {
  SceneBuilder builder = with_square(300, 0, .8);
  builder.scene().lights.points.push_back({"p", 2 * z, grey(5)});
  const scene::Scene scene = builder.finish();
  const double r2 = 4 + 9;
  expect_agreement(scene, {at_point(Vec3(3, 0, 0), z, 5 / r2 * 2 / std::sqrt(r2))}, {.samples = 1000}, .01);
}

// A uniform sky and ground: by how much of each a receiver sees.
TEST(Skies, light_by_what_is_seen_of_them) {
  for (const double ground : {0., .3}) {
    SceneBuilder builder = with_square(.01, -5, 0);
    builder.scene().lights.sky = scene::Sky{z, grey(2), grey(2 * ground)};
    const scene::Scene scene = builder.finish();
    std::vector<Question> questions;
    for (const double tilt : {0., 45., 90., 135.}) {
      const double up = (1 + std::cos(tilt * pi / 180)) / 2;
      questions.push_back(at_point(Vec3::Zero(), tilted(tilt), 2 * pi * (up + ground * (1 - up))));
    }
    for (Question& q : questions) q.slack = 1e-4;  // of the square, which hides 4e-6 of the ground
    expect_agreement(scene, questions, {.samples = 100'000}, .01);
  }
}

// A room without walls: a furnace by the sky, whatever the reflectance.
TEST(Skies, cannot_tell_a_white_body_from_nothing) {
  SceneBuilder builder({"grey"});
  builder.add_box("box", {Vec3(-1, -1, -1), Vec3(1, 1, 1)}, builder.add_material(test::diffuse("m", .8, 0)));
  builder.scene().lights.sky = scene::EnvironmentMap(z, y, 4, 8, std::vector<Spectrum>(32, grey(1)));
  builder.scene().cameras.push_back({"c", Vec3(3, 3, 3), Vec3(0, 0, 0), z, 20, 1, 1});
  const scene::Scene scene = builder.finish();
  expect_agreement(
      scene,
      {whole(scene, "box/z+", pi), whole(scene, "box/x-", pi), {measure::PixelRadiance{{0}, 0, 0}, grey(.8), "pixel"}},
      {.samples = 100'000}, .01);
}

// Sunlight, by the cosine, and through a pane, by what that lets pass.
TEST(Suns, light_floors_also_through_panes) {
  for (const double radius : {scene::Sun::seen_from_earth, .05, 0.}) {
    SceneBuilder builder = with_square(2, 0, 0);
    scene::Material pane;
    pane.finish = scene::Pane{grey(.9230769230), 1.5};
    pane.sides = scene::Sides::both;
    builder.add_polygon("pane", {{Vec3(0, -2, 1), Vec3(2, -2, 1), Vec3(2, 2, 1), Vec3(0, 2, 1)}, {}},
                        builder.add_material(pane));
    builder.scene().lights.suns.push_back({"sun", Vec3(0, -1, -1).normalized(), grey(7), radius});
    const scene::Scene scene = builder.finish();
    const double H = 7 * std::sqrt(.5);
    std::vector<Question> questions{at_point(Vec3(-1, 0, 1.5), z, H), at_point(Vec3(1, -1, .5), z, H * .9073443298)};
    questions[1].slack = 1e-8 + 3 * radius * radius;  // what passes changes over the disk
    // What the pane reflects is none of the question: of a sun without an angle it would not be found.
    expect_agreement(scene, questions, {.samples = 20'000, .paths = measure::PathClasses::of("(F|B)(D|G)*E")}, .03);
  }
}

// 1e4 lights in a room that closes around them: flux in, flux out.
TEST(ManyLights, send_all_their_flux_to_a_closed_black_room) {
  SceneBuilder builder({"grey"});
  builder.add_box("room", {Vec3(0, 0, 0), Vec3(10, 10, 10)}, builder.add_material(test::diffuse("m", 0, 0)),
                  SceneBuilder::Facing::inward);
  core::RandomNumbers numbers(1, 0, 0);
  double flux = 0;
  for (int k = 0; k < 10'000; ++k) {
    const Vec3 at = Vec3::Constant(.5) + 9 * test::random_point(numbers);
    const Spectrum I = grey(std::pow(10, 6 * numbers.next()));
    if (k % 2 == 0)
      builder.scene().lights.points.push_back({"p", at, I});
    else
      builder.scene().lights.spots.push_back({"s", at, test::cosine_about(z, numbers), I, .9, .5});
    flux += k % 2 == 0 ? builder.scene().lights.points.back().flux()[0] : builder.scene().lights.spots.back().flux()[0];
  }
  const scene::Scene scene = builder.finish();
  expect_agreement(scene, {{test::all_fronts(scene), grey(flux), "all"}}, {.samples = 200'000}, .02);
}

}  // namespace
}  // namespace interflect::montecarlo

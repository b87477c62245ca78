#include "montecarlo/bsdf/of_material.h"
#include "tests/montecarlo/statistics.h"
#include "tests/support/shapes.h"

// Surfaces that are not diffuse, against closed forms.  E / (pi L) is the form factor that is seen: times the exitance
// it is the irradiance.
namespace interflect::montecarlo {
namespace {

using scene::SceneBuilder;
using test::at_point;
using test::expect_agreement;
using test::Question;
using test::whole;

/// Parallelograms of materials, front along u x v.
class Parts {
 public:
  scene::SurfaceId add(const char* name, const Vec3& corner, const Vec3& u, const Vec3& v, scene::Material material) {
    material.name = name;
    return builder_.add_polygon(name, {{corner, corner + u, corner + u + v, corner + v}, {}},
                                builder_.add_material(std::move(material)));
  }
  scene::SurfaceId light(const char* name, const Vec3& corner, const Vec3& u, const Vec3& v) {
    return add(name, corner, u, v, test::diffuse(name, 0, 1));
  }
  SceneBuilder& builder() { return builder_; }
  scene::Scene finish() { return builder_.finish(); }

 private:
  SceneBuilder builder_{{"grey"}};
};

scene::Material of(scene::Finish finish, scene::Sides sides = scene::Sides::both, double diffuse = 0) {
  scene::Material material;
  material.finish = std::move(finish);
  material.sides = sides;
  material.reflectance[0] = diffuse;
  return material;
}
scene::Material mirror(double R) { return of(scene::Mirror{test::grey(R)}); }

const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();

// What a material is said to do is what its Bsdf does: that is built without it in mind.
TEST(Materials, do_what_they_are_said_to_without_their_tables) {
  const auto said_by = [](const std::unique_ptr<Bsdf>& bsdf) {
    if (!bsdf) return Scatters{};
    const bool joins = !bsdf->only_delta(), glossy = bsdf->glossy();
    return Scatters{joins && !glossy, joins && glossy, bsdf->mirrors()};
  };
  const scene::Metal::Index index{test::grey(.2), test::grey(3)};
  std::size_t kinds[3] = {};
  for (const scene::Finish& finish : std::initializer_list<scene::Finish>{
           scene::Lambertian{}, scene::Mirror{test::grey(.8)}, scene::Metal{test::grey(.8), 0},
           scene::Metal{test::grey(.8), 9e-4}, scene::Metal{index, 1.1e-3}, scene::Metal{index, .4},
           scene::Glass{1.5, 0}, scene::Glass{1.5, .3}, scene::Glass{1, 0}, scene::Glass{1, .3}, scene::Glass{.7, 0},
           scene::Pane{test::grey(.8), 1.5}, scene::Plastic{1.5}})
    for (const double diffuse : {0.0, .5})
      for (const scene::Sides sides : {scene::Sides::front, scene::Sides::both})
        for (const double opacity : {.5, 1.0}) {
          scene::Material material = of(finish, sides, diffuse);
          material.opacity = opacity;
          const Scatters found = scatters_of(material), expected = said_by(bsdf_of(material));
          EXPECT_EQ(found, expected) << scene::type_of(finish) << ' ' << finish.index() << ' ' << diffuse;
          kinds[0] += found.diffuse, kinds[1] += found.glossy, kinds[2] += found.specular;
        }
  for (const std::size_t of_kind : kinds) EXPECT_GE(of_kind, 8u);
  scene::Material gone = mirror(.8);
  gone.opacity = 0;
  EXPECT_EQ(scatters_of(gone), Scatters{});
}

// Two mirrors face each other and a light lies between their tops: images without end.
TEST(Mirrors, of_a_corridor_show_a_row_of_lights) {
  const struct {
    double R, at[3];
  } known[] = {{.5, {.331796634769, .322652005163, .299583782187}},
               {.9, {.421364518170, .419363803599, .414223107334}},
               {1, {.447213595500, .447213595500, .447213595500}}};
  const double places[] = {.5, .25, .01};
  for (const auto& [R, at] : known) {
    Parts parts;
    parts.add("left", -.5 * y, y, z, mirror(R));
    parts.add("right", x - .5 * y, z, y, mirror(R));
    parts.light("light", -.5 * y + z, y, x);
    const scene::Scene scene = parts.finish();
    std::vector<Question> questions;
    for (std::size_t k = 0; k < 3; ++k) questions.push_back(at_point(places[k] * x, z, at[k]));
    expect_agreement(scene, questions, {.samples = 100'000}, .01);
    expect_agreement(scene, questions, {.samples = 5'000, .intersector = "brute"}, .05);
  }
}

// Light and receiver lie in a ceiling over a mirror: the receiver sees the light at twice the distance.
TEST(Mirrors, throw_light_back_at_a_ceiling) {
  const struct { double dx, dy, F; } known[] = {{1, 0, .0480641029851}, {2, 0, .0206092776988}, {1, 1, .0351071009097}};
  for (const auto& [dx, dy, F] : known) {
    Parts parts;
    parts.light("light", z, y, x);
    parts.add("receiver", z + dx * x + dy * y, y, x, test::diffuse("r", 0, 0));
    parts.add("floor", -20 * (x + y), 40 * x, 40 * y, mirror(.8));
    const scene::Scene scene = parts.finish();
    expect_agreement(scene, {whole(scene, "receiver", .8 * F)}, {.samples = 100'000}, .03);
  }
}

// A mirror that is too small shows a part of the light, and at last none.
TEST(Mirrors, that_are_small_show_a_part) {
  const struct {
    double half, X, F;
  } known[] = {
      {.5, .75, .0405845562682}, {.5, 1, .0200780393487}, {.5, 1.5, 0}, {.25, .75, .011140759891}, {.25, 1, 0}};
  for (const auto& [half, X, F] : known) {
    Parts parts;
    parts.light("light", z - .5 * (x + y), y, x);
    parts.add("mirror", -half * (x + y), 2 * half * x, 2 * half * y, mirror(1));
    const scene::Scene scene = parts.finish();
    if (F > 0) {
      expect_agreement(scene, {at_point(X * x + z, -z, F)}, {.samples = 200'000}, .03);
    } else {
      core::LocalRun run(1);
      const std::vector<measure::Measurement> asked{measure::PointIrradiance{X * x + z, -z, {}}};
      EXPECT_EQ(PathTracer({.samples = 50'000}).answer(scene, asked, run.get())[0].value[0], 0);
    }
  }
}

// Diffuse plates between mirrors exchange light as endless ones do, the more the better the mirrors are.
TEST(Mirrors, around_plates_make_them_larger) {
  const struct {
    double R, B1, B2;
  } known[] = {{.5, 1.0526293577, .2351889751}, {.9, 1.2120300836, .5069305242}, {1, 4. / 3, 2. / 3}};
  for (const auto& [R, B1, B2] : known) {
    Parts parts;
    parts.add("lower", Vec3::Zero(), x, y, test::diffuse("l", .5, 1));
    parts.add("upper", z, y, x, test::diffuse("u", .5, 0));
    parts.add("south", Vec3::Zero(), x, z, mirror(R));
    parts.add("north", y, x, z, mirror(R));
    parts.add("west", Vec3::Zero(), y, z, mirror(R));
    parts.add("east", x, y, z, mirror(R));
    const scene::Scene scene = parts.finish();
    expect_agreement(scene, {whole(scene, "lower", (B1 - 1) / .5), whole(scene, "upper", B2 / .5)},
                     {.samples = 200'000}, .01);
  }
}

// A pane between a lamp and what it lights: T of each polarisation by itself, at every angle.  Both ways of finding the
// lamp see through it.
TEST(Panes, let_pass_what_is_known) {
  Parts parts;
  parts.light("lamp", z - .5 * (x + y), y, x);
  parts.add("pane", .5 * z - 3 * (x + y), 6 * x, 6 * y, of(scene::Pane{test::grey(scene::most_transmitted(1.5)), 1.5}));
  const scene::Scene scene = parts.finish();
  const std::vector<Question> questions{at_point(Vec3::Zero(), z, .220867477956), at_point(x, z, .0766765228905)};
  expect_agreement(scene, questions, {.samples = 400'000}, .005);
}

// A mask of half the area lets half pass, twice of it a quarter.
TEST(Masks, let_pass_their_part) {
  for (const int screens : {1, 2}) {
    Parts parts;
    parts.light("lamp", z - .5 * (x + y), y, x);
    for (int k = 0; k < screens; ++k) {
      scene::Material net = test::diffuse("net", 0, 0, scene::Sides::both);
      net.opacity = .5;
      parts.add("net", (.3 + .2 * k) * z - 3 * (x + y), 6 * x, 6 * y, net);
    }
    const scene::Scene scene = parts.finish();
    expect_agreement(scene, {at_point(Vec3::Zero(), z, std::pow(.5, screens) * .2394564705)}, {.samples = 200'000},
                     .005);
  }
}

/// A box that shines inside, around all.
void shine_all_around(Parts& parts, double size) {
  const auto id = parts.builder().add_material(test::diffuse("sky", 0, 1));
  parts.builder().add_box("sky", geometry::Box(Vec3::Constant(-size), Vec3::Constant(size)), id,
                          SceneBuilder::Facing::inward);
}

// Under water a horizontal place receives pi L (1 - F_e) of a uniform sky: radiance rises by n², and most directions see
// the sky no more.
TEST(Glass, lets_a_uniform_sky_in) {
  Parts parts;
  shine_all_around(parts, 50);
  parts.add("water", -4 * (x + y), 8 * x, 8 * y, of(scene::Glass{1.5, 0}));
  parts.add("bottom", -z - 8 * (x + y), 16 * x, 16 * y, test::diffuse("b", 0, 0));
  for (const auto& [corner, side] : {std::pair<Vec3, Vec3>{-4 * (x + y), 8 * x},
                                     {-4 * (x + y), 8 * y},
                                     {4 * (x + y), -8 * x},
                                     {4 * (x + y), -8 * y}})
    parts.add("bank", corner, side, -z, test::diffuse("k", 0, 0, scene::Sides::both));
  const scene::Scene scene = parts.finish();
  expect_agreement(scene, {at_point(-.1 * z, z, .9082220407)}, {.samples = 100'000}, .01);
}

// What loses nothing is invisible where all around is equally bright: bodies of glass, rough or not, of metal, plastic.
TEST(Materials, that_lose_nothing_are_invisible_among_equal_light) {
  const std::vector<scene::Material> kinds{
      mirror(1),
      of(scene::Metal{test::grey(1), 0}),
      of(scene::Metal{test::grey(1), .3}),
      of(scene::Glass{1.5, 0}),
      of(scene::Glass{1.5, .3}),
      of(scene::Pane{test::grey(scene::most_transmitted(1.5)), 1.5}),
      of(scene::Plastic{1.5}, scene::Sides::both, .999999999),
  };
  std::size_t kind = 0;
  for (const scene::Material& material : kinds) {
    Parts parts;
    shine_all_around(parts, 3);
    parts.builder().add_facets("body", test::icosphere(1, 1, false), parts.builder().add_material(material));
    parts.builder().scene().cameras.push_back({"c", Vec3(0, -2, .3), Vec3(.2, 0, 0), z, 60, 4, 4});
    const scene::Scene scene = parts.finish();
    std::vector<Question> questions;
    for (int k = 0; k < 4; ++k)
      questions.push_back(
          {measure::PixelRadiance{{0}, k, 3 - k}, test::grey(inv_pi), "pixel of " + std::to_string(kind), 3e-4});
    questions.push_back(at_point(Vec3(1.2, .3, .1), -x, 1));
    questions.back().slack = 3e-4;
    expect_agreement(scene, questions, {.samples = 20'000}, .05);
    ++kind;
  }
}

// In a body of glass all light is squeezed: its radiance is n² of that outside, whatever way it goes.
TEST(Glass, holds_light_that_is_brighter_by_the_square_of_the_index) {
  Parts parts;
  shine_all_around(parts, 3);
  parts.builder().add_facets("ball", test::icosphere(3, 1, false),
                             parts.builder().add_material(of(scene::Glass{1.5, 0})));
  parts.builder().scene().cameras.push_back({"c", Vec3(.1, .05, 0), Vec3(.3, .5, .2), z, 90, 2, 2});
  const scene::Scene scene = parts.finish();
  expect_agreement(
      scene,
      {{measure::PixelRadiance{{0}, 0, 1}, test::grey(2.25 * inv_pi), "pixel"}, at_point(Vec3(.2, 0, .1), z, 2.25)},
      {.samples = 50'000}, .02);
}

// The control of those furnaces: what loses a tenth is seen.
TEST(Materials, that_lose_light_are_seen) {
  Parts parts;
  shine_all_around(parts, 3);
  parts.builder().add_facets("body", test::icosphere(1, 1, false),
                             parts.builder().add_material(of(scene::Metal{test::grey(.9), .3})));
  parts.builder().scene().cameras.push_back({"c", Vec3(0, -2, 0), Vec3(0, 0, 0), z, 20, 1, 1});
  core::LocalRun run(1);
  const scene::Scene scene = parts.finish();
  const std::vector<measure::Measurement> asked{measure::PixelRadiance{{0}, 0, 0}};
  const double L = PathTracer({.samples = 20'000}).answer(scene, asked, run.get())[0].value[0];
  EXPECT_LT(L, .93 * inv_pi);
  EXPECT_GT(L, .85 * inv_pi);
}

}  // namespace
}  // namespace interflect::montecarlo

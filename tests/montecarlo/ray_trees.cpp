#include "montecarlo/bsdf/of_material.h"
#include "montecarlo/ray_tree/distributed.h"
#include "montecarlo/ray_tree/whitted.h"
#include "montecarlo/render.h"
#include "tests/montecarlo/rooms.h"
#include "tests/montecarlo/statistics.h"

// Trees of rays, with chance and without, against closed forms and against path tracing of the same classes of paths.
namespace interflect::montecarlo {
namespace {

using scene::SceneBuilder;

const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();

scene::MaterialId with(SceneBuilder& builder, scene::Finish finish) {
  scene::Material material;
  material.finish = std::move(finish);
  material.sides = scene::Sides::both;
  return builder.add_material(material);
}

/// A tiny pixel that looks from the eye along a direction.
void look(SceneBuilder& builder, const Vec3& eye, const Vec3& target, const Vec3& up) {
  builder.scene().cameras.push_back({"c" + std::to_string(builder.scene().cameras.size()), eye, target, up,
                                     scene::Projection(scene::Orthographic{1e-6}), 1, 1});
}

Estimate pixel(const measure::Method& method, const scene::Scene& scene, std::uint32_t camera = 0) {
  core::LocalRun run(1);
  const measure::Measurement asked = measure::PixelRadiance{{camera}, 0, 0};
  return method.answer(scene, {&asked, 1}, run.get())[0];
}

/// Of the truth 5e-5 is forgiven: pixels have a size, and rays start a little beside their surfaces.
void expect_within(const Estimate& found, double truth, double largest_error, const std::string& what = "") {
  const double error = found.error_bound[0] + 4 * found.standard_error[0];
  EXPECT_NEAR(found.value[0], truth, error + 5e-5 * truth) << what;
  EXPECT_LE(error, largest_error * truth) << what;
}

// A point over a floor, seen at once and in a mirror: L = rho I cos / (pi d²), times R.
TEST(Whitted, sees_a_point_light_s_floor_directly_and_in_a_mirror) {
  SceneBuilder builder({"grey"});
  builder.add_polygon("floor", test::parallelogram(Vec3(-4, -4, 0), 8 * x, 8 * y),
                      builder.add_material(test::diffuse("f", .6, 0)));
  const auto mirror = with(builder, scene::Mirror{test::grey(.8)});
  builder.add_polygon("mirror", test::parallelogram(Vec3(3, -2, .5), 4 * y, 3 * z), mirror);
  builder.add_polygon("other", test::parallelogram(Vec3(-3, -2, .5), 4 * y, 3 * z), mirror);
  builder.scene().lights.points.push_back({"p", Vec3(1, 0, 2), test::grey(5)});
  const auto lit = [](const Vec3& at) {
    const Vec3 way = Vec3(1, 0, 2) - at;
    return .6 * inv_pi * 5 * way.z() / std::pow(way.norm(), 3);
  };
  look(builder, Vec3(0, 0, 1), Vec3(1, 1, 0), z);
  look(builder, Vec3(0, 0, 2), Vec3(3, 0, 1.25), z);  // and, on its way back, the floor at x = 3 - 1.25 * 3 / .75
  const scene::Scene scene = builder.finish();
  const auto paths = measure::PathClasses::of("PDS*E");
  for (const measure::Method* method : std::initializer_list<const measure::Method*>{
           new Whitted({.paths = paths}), new Distributed({.samples = 1000, .paths = paths})}) {
    const std::unique_ptr<const measure::Method> owned(method);
    expect_within(pixel(*method, scene, 0), lit(Vec3(1, 1, 0)), 5e-3, method->name());
    expect_within(pixel(*method, scene, 1), .8 * lit(Vec3(-2, 0, 0)), 5e-3, method->name());
  }
}

// Straight down through a slab of glass onto a bright floor: of its two faces' reflections back and forth
// (1 - F) / (1 + F) is left, of a pane what core::Pane says.
TEST(RayTrees, follow_all_reflections_within_glass) {
  for (const bool pane : {false, true}) {
    SceneBuilder builder({"grey"});
    builder.add_polygon("floor", test::parallelogram(Vec3(-1, -1, 0), 2 * x, 2 * y),
                        builder.add_material(test::diffuse("f", 0, 1)));
    if (pane)
      builder.add_polygon("pane", test::parallelogram(Vec3(-1, -1, .5), 2 * x, 2 * y),
                          with(builder, scene::Pane{test::grey(.8)}));
    else
      builder.add_box("slab", {Vec3(-1, -1, .5), Vec3(1, 1, .7)}, with(builder, scene::Glass{1.5, 0}));
    look(builder, Vec3(.1, .2, 1), Vec3(.1, .2, 0), y);
    const scene::Scene scene = builder.finish();
    const double truth = inv_pi * (pane ? .8 : .9230769230769231);
    expect_within(pixel(Whitted(), scene), truth, 1e-3, "whitted");
    expect_within(pixel(Distributed({.samples = 40'000}), scene), truth, 1e-2, "distributed");
  }
}

// A ball's light at a point whose horizon it crosses or not (sin alpha = R / d = 1/2): docs/truths.md.
TEST(RayTrees, know_the_light_of_a_ball) {
  const auto straight = measure::PathClasses::of("LE");
  for (const double scale : {1e-6, 1.0, 1e6}) {
    SceneBuilder builder({"grey"});
    builder.scene().lights.spheres.push_back({"b", scale * Vec3(0, 0, 2), scale, test::grey(1)});
    builder.add_polygon("something", test::parallelogram(scale * Vec3(5, 5, 5), scale * x, scale * y),
                        builder.add_material(test::diffuse("s", .5, 0)));
    const scene::Scene scene = builder.finish();
    for (const auto& [degrees, truth] : std::vector<std::pair<double, double>>{{0, .25},
                                                                               {45, .176776695297},
                                                                               {60, .125},
                                                                               {70, .087654603349},
                                                                               {80, .0546958164455},
                                                                               {90, .0288344428112}}) {
      const double tilt = degrees * pi / 180;
      const measure::Measurement asked =
          measure::PointIrradiance{Vec3::Zero(), Vec3(std::sin(tilt), 0, std::cos(tilt)), {}};
      core::LocalRun run(1);
      expect_within(
          Whitted({.target = 1e-3, .target_floor = 0, .paths = straight}).answer(scene, {&asked, 1}, run.get())[0],
          truth, 5e-3, "whitted");
      expect_within(Distributed({.samples = 40'000, .paths = straight}).answer(scene, {&asked, 1}, run.get())[0], truth,
                    .05, "distributed");
    }
  }
}

// Between two mirrors to a lamp at their end, by four reflections: R⁴ L.  What is cut is no more than the bound says.
TEST(RayTrees, count_reflections_and_bound_what_they_cut) {
  SceneBuilder builder({"grey"});
  const auto mirror = with(builder, scene::Mirror{test::grey(.8)});
  builder.add_polygon("one", test::parallelogram(Vec3(0, -1, -1), 2 * y, 6 * z), mirror);
  builder.add_polygon("other", test::parallelogram(Vec3(1, -1, -1), 2 * y, 6 * z), mirror);
  builder.add_polygon("lamp", test::parallelogram(Vec3(0, -1, 4), 2 * y, x),
                      builder.add_material(test::diffuse("l", 0, 1)));
  look(builder, Vec3(.5, 0, 0), Vec3(1, 0, .5), y);
  const scene::Scene scene = builder.finish();
  const double truth = .8 * .8 * .8 * .8 * inv_pi;
  expect_within(pixel(Whitted(), scene), truth, 1e-9, "whitted");
  expect_within(pixel(Distributed({.samples = 10'000}), scene), truth, 5e-3, "distributed");
  for (const double least : {.9, .7, .6, .5}) {
    const Estimate cut = pixel(Whitted({.samples = 4096, .least_weight = least}), scene);
    EXPECT_EQ(cut.value[0], 0) << least;
    EXPECT_GE(cut.error_bound[0], truth) << least;
    EXPECT_LE(cut.error_bound[0], 1.01 * least * inv_pi) << least;
  }
}

// What loses nothing cannot be seen where all walls are equally bright; what loses a tenth can.
TEST(RayTrees, do_not_see_what_loses_nothing_in_a_furnace) {
  scene::Material white;
  white.finish = scene::Plastic{1.5}, white.reflectance = test::grey(1);
  const auto of = [](scene::Finish finish) {
    scene::Material material;
    material.finish = std::move(finish);
    return material;
  };
  const std::vector<std::pair<std::string, scene::Material>> kinds{
      {"mirror", of(scene::Mirror{test::grey(1)})},
      {"metal", of(scene::Metal{test::grey(1), .4})},
      {"glass", of(scene::Glass{1.5, 0})},
      {"pane", of(scene::Pane{test::grey(1)})},
      {"plastic", white},
      {"lossy", of(scene::Mirror{test::grey(.9)})},
      {"lossy metal", of(scene::Metal{test::grey(.9), .4})}};
  for (const auto& [name, material] : kinds) {
    SceneBuilder builder({"grey"});
    builder.add_box("room", {Vec3(0, 0, 0), Vec3(3, 2, 2)}, builder.add_material(test::diffuse("w", 0, 1)),
                    SceneBuilder::Facing::inward);
    scene::Material both_sides = material;
    both_sides.sides = scene::Sides::both;
    builder.add_box("block", {Vec3(1.6, .6, .6), Vec3(2.4, 1.3, 1.2)}, builder.add_material(both_sides));
    builder.scene().cameras.push_back({"c", Vec3(.3, .5, 1.5), Vec3(2, .95, .9), z, 40, 1, 1});
    const scene::Scene scene = builder.finish();
    // A block that is convex scatters once what is not delta: none of its faces sees another from without.
    const auto paths = measure::PathClasses::of("A(D|G)?S*E");
    const Estimate by_chance = pixel(Distributed({.samples = 100'000, .paths = paths}), scene),
                   fixed = pixel(Whitted({.paths = paths}), scene);
    if (name.starts_with("lossy")) {
      for (const Estimate& each : {by_chance, fixed})
        EXPECT_GT(inv_pi - each.value[0], 10 * each.standard_error[0] + each.error_bound[0]) << name;
    } else {
      expect_within(by_chance, inv_pi, 1e-2, name + " distributed");
      expect_within(fixed, inv_pi, 2e-2, name + " whitted");
    }
  }
}

// A rough metal plate lit by a square lamp, seen at 45 degrees: int f L cos cos' / d² dA over the lamp, by midpoints.
TEST(RayTrees, reflect_a_lamp_in_a_glossy_plate_as_its_quadrature_does) {
  for (const double alpha : {.15, .5}) {
    SceneBuilder builder({"grey"});
    scene::Material metal;
    metal.finish = scene::Metal{test::grey(.7), alpha};
    builder.add_polygon("plate", test::parallelogram(Vec3(-1, -1, 0), 2 * x, 2 * y), builder.add_material(metal));
    builder.add_polygon("lamp", test::parallelogram(Vec3(.3, -.4, 1), .8 * y, .6 * x),
                        builder.add_material(test::diffuse("l", 0, 1)));
    look(builder, Vec3(-1, 0, 1), Vec3::Zero(), y);
    const scene::Scene scene = builder.finish();
    const auto bsdf = bsdf_of(metal);
    const Vec3 to_eye = Vec3(-1, 0, 1).normalized();
    constexpr int n = 300;
    double truth = 0;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const Vec3 on(.3 + .6 * (i + .5) / n, -.4 + .8 * (j + .5) / n, 1);
        const Vec3 way = on.normalized();
        truth += bsdf->f(way, to_eye)[0] * inv_pi * way.z() * way.z() / on.squaredNorm() * (.6 * .8 / (n * n));
      }
    const auto paths = measure::PathClasses::of("AGE");
    expect_within(pixel(Distributed({.samples = 100'000, .paths = paths}), scene), truth, 2e-2, "distributed");
    expect_within(pixel(Whitted({.target_floor = 0, .paths = paths}), scene), truth, 2e-2, "whitted");
  }
}

// Path tracing of the same classes is the same, in a room of every material and by cameras of every kind.
TEST(RayTrees, agree_with_path_tracing_of_their_classes) {
  const scene::Scene scene = test::shiny();
  std::vector<measure::Measurement> asked;
  for (std::uint32_t camera = 0; camera < 5; ++camera)
    for (const int k : {0, 1, 2}) asked.push_back(measure::PixelRadiance{{camera}, 1 + (k == 1), 1 + (k == 2)});
  const auto distributed = measure::PathClasses::of("L(D|G)?(S|G)*E"), whitted = measure::PathClasses::of("L(D|G)?S*E");
  test::expect_same(Distributed({.samples = 200'000, .paths = distributed}),
                    PathTracer({.samples = 200'000, .paths = distributed}), scene, asked, .1);
  core::LocalRun run(1);
  const auto known = PathTracer({.samples = 200'000, .paths = whitted}).answer(scene, asked, run.get()),
             found = Whitted({.max_samples = 1u << 15, .paths = whitted}).answer(scene, asked, run.get());
  const double limit = test::critical_z(test::alpha, 2 * asked.size());
  int well_known = 0;
  for (std::size_t m = 0; m < asked.size(); ++m)
    for (int c = 0; c < 2; ++c) {
      EXPECT_NEAR(found[m].value[c], known[m].value[c], limit * known[m].standard_error[c] + found[m].error_bound[c])
          << m << ", channel " << c;
      well_known += found[m].error_bound[c] < .1 * found[m].value[c];
    }
  EXPECT_GT(well_known, 20);
}

// And so are patches, fluxes and points by light of every kind that comes straight, and of pixels by one surface.
TEST(RayTrees, agree_with_path_tracing_on_every_kind_of_light) {
  const scene::Scene scene = test::lit_by_all();
  std::vector<measure::Measurement> asked;
  for (const scene::SurfaceId id : scene.surface_ids())
    asked.push_back(measure::Flux{measure::patches_of(scene, id, scene::Side::front)});
  asked.push_back(measure::PointIrradiance{Vec3(2, 1, .2), z, {}});
  const auto straight = measure::PathClasses::of("LE");
  test::expect_same(Distributed({.samples = 60'000, .paths = straight}),
                    PathTracer({.samples = 60'000, .paths = straight}), scene, asked, .05);
  core::LocalRun run(1);
  const auto known = PathTracer({.samples = 200'000, .paths = straight}).answer(scene, asked, run.get()),
             found = Whitted({.paths = straight}).answer(scene, asked, run.get());
  const double limit = test::critical_z(test::alpha, 2 * asked.size());
  for (std::size_t m = 0; m < asked.size(); ++m)
    for (int c = 0; c < 2; ++c) {
      EXPECT_NEAR(found[m].value[c], known[m].value[c], limit * known[m].standard_error[c] + found[m].error_bound[c])
          << m << ", channel " << c;
      EXPECT_LT(found[m].error_bound[c], .1 * found[m].value[c]) << m;
    }
}

// Of 200 seeds 95 % intervals hold the truth in 181 .. 197 with a probability of .995; to a target, too.
TEST(Distributed, holds_the_truth_as_often_as_it_says) {
  const scene::Scene scene = test::facing_squares();
  const std::vector<measure::Measurement> flux{
      measure::Flux{measure::patches_of(scene, test::surface_named(scene, "upper"), scene::Side::front)},
      measure::PointIrradiance{Vec3(.5, .5, 1), -z, test::surface_named(scene, "upper")}},
      seen{measure::PixelRadiance{{0}, 0, 0}};
  const double truth[] = {.199824895698, .2394564705, .199824895698 * .5 * inv_pi};
  int held[] = {0, 0, 0};
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    core::LocalRun run(seed, 2);
    auto found = Distributed({.samples = 1000, .paths = measure::PathClasses::of("LE")}).answer(scene, flux, run.get());
    found.push_back(
        Distributed({.target = .02, .paths = measure::PathClasses::of("LDE")}).answer(scene, seen, run.get())[0]);
    for (std::size_t m = 0; m < 3; ++m)
      held[m] += std::abs(found[m].value[0] - truth[m]) <= normal_95 * found[m].standard_error[0];
  }
  for (const int each : held) {
    EXPECT_GE(each, 181);
    EXPECT_LE(each, 197);
  }
}

TEST(RayTrees, have_the_same_bits_for_any_number_of_threads) {
  const scene::Scene scene = test::shiny();
  const std::vector<measure::Measurement> asked{measure::PixelRadiance{{0}, 1, 1}, measure::PixelRadiance{{1}, 2, 1}};
  const auto paths = measure::PathClasses::of("L(D|G)?S*E");
  for (const bool chance : {false, true}) {
    std::vector<std::vector<Estimate>> found;
    for (const unsigned threads : {1u, 2u, 3u, 8u}) {
      core::LocalRun run(7, threads);
      found.push_back(chance ? Distributed({.samples = 2000, .paths = paths}).answer(scene, asked, run.get())
                             : Whitted({.samples = 2048, .paths = paths}).answer(scene, asked, run.get()));
    }
    for (const auto& each : found)
      for (std::size_t m = 0; m < asked.size(); ++m) {
        EXPECT_EQ(each[m].value, found[0][m].value);
        EXPECT_EQ(each[m].standard_error, found[0][m].standard_error);
        EXPECT_EQ(each[m].weighed_standard_error, found[0][m].weighed_standard_error);
        EXPECT_EQ(each[m].error_bound, found[0][m].error_bound);
      }
  }
}

// What is drawn on the lens says nothing of what is drawn on the lights: a floor out of focus beside a low lamp.
TEST(Whitted, draws_the_lens_and_the_lights_apart) {
  SceneBuilder builder({"grey"});
  builder.add_polygon("floor", test::parallelogram(Vec3(-4, -4, 0), 8 * x, 8 * y),
                      builder.add_material(test::diffuse("f", .6, 0)));
  builder.add_polygon("lamp", test::parallelogram(Vec3(.35, -.3, 0), .3 * z, .6 * y),
                      builder.add_material(test::diffuse("l", 0, 1)));
  for (const Vec3& up : {x, y})
    builder.scene().cameras.push_back({"c" + std::to_string(builder.scene().cameras.size()), Vec3(0, 0, 2),
                                       Vec3(0, 0, 0), up, scene::Projection(scene::ThinLens{.1, .3, 1}), 1, 1});
  const scene::Scene scene = builder.finish();
  const auto once = measure::PathClasses::of("ADE");
  for (const std::uint32_t camera : {0u, 1u}) {
    const Estimate found = pixel(Whitted({.target = 1e-3, .target_floor = 0, .paths = once}), scene, camera);
    const Estimate known = pixel(Distributed({.samples = 1'000'000, .paths = once}), scene, camera);
    EXPECT_NEAR(found.value[0], known.value[0], found.error_bound[0] + 4 * known.standard_error[0]) << camera;
    EXPECT_LT(found.error_bound[0], 5e-3 * found.value[0]);
    EXPECT_LT(known.standard_error[0], 2e-3 * known.value[0]);
  }
}

// Between mirrors that lose nothing trees end, and what they leave out is told.
TEST(Whitted, ends_between_mirrors_and_says_what_it_left_out) {
  SceneBuilder builder({"grey"});
  const auto mirror = with(builder, scene::Mirror{test::grey(1)});
  builder.add_polygon("one", test::parallelogram(Vec3(0, -2, -2), 4 * y, 4 * z), mirror);
  builder.add_polygon("other", test::parallelogram(Vec3(1, -2, -2), 4 * y, 4 * z), mirror);
  builder.add_polygon("lamp", test::parallelogram(Vec3(.3, 0, 0), .2 * x, .2 * y),
                      builder.add_material(test::diffuse("l", 0, 1)));
  look(builder, Vec3(.5, 1, 1), Vec3(1, 1, 1), z);
  const scene::Scene scene = builder.finish();
  const Estimate found = pixel(Whitted({.samples = 64}), scene);
  EXPECT_EQ(found.value[0], 0);
  EXPECT_GT(found.error_bound[0], 0);
  // A picture's errors have it too, and nothing else: all trees are alike.
  core::LocalRun run(1);
  const auto rays = raycast::make_ray_caster("embree", scene);
  RenderSettings settings;
  settings.integrator = "whitted", settings.samples = 64;
  const Rendering picture = render(scene, {0}, settings, run, *rays);
  const double nothing_found = 3 * inv_pi / 64;
  EXPECT_EQ(picture.radiance.data[0], 0);
  EXPECT_GT(picture.standard_error.data[0], 1.01 * nothing_found);
  EXPECT_NEAR(picture.standard_error.data[0], nothing_found + inv_pi / normal_95, 1e-6);
  // And a run that goes on.
  FilmState half;
  RenderCheckpoints checkpoints;
  checkpoints.seconds_between = 0, checkpoints.at_end = true;
  checkpoints.keep = [&](const FilmState& state) { half = state; };
  settings.samples = 32;
  render(scene, {0}, settings, run, *rays, checkpoints);
  checkpoints = {&half};
  settings.samples = 64;
  EXPECT_EQ(render(scene, {0}, settings, run, *rays, checkpoints).standard_error.data, picture.standard_error.data);
}

// Whatever the seed: a picture by whitted has no chance in it.
TEST(Whitted, draws_the_same_picture_by_any_seed) {
  const scene::Scene scene = test::furnished(1);
  const auto rays = raycast::make_ray_caster("embree", scene);
  RenderSettings settings;
  settings.integrator = "whitted", settings.samples = 32, settings.paths = measure::PathClasses::of("L(D|G)?S*E");
  core::LocalRun one(1, 1), other(2, 3);
  const Rendering a = render(scene, {0}, settings, one, *rays), b = render(scene, {0}, settings, other, *rays);
  EXPECT_EQ(a.radiance.data, b.radiance.data);
  EXPECT_EQ(a.standard_error.data, b.standard_error.data);
  settings.samples = 20;
  EXPECT_THROW(render(scene, {0}, settings, one, *rays), core::InputError);
}

}  // namespace
}  // namespace interflect::montecarlo

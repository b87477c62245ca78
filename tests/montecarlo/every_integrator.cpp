#include "montecarlo/bidirectional/bidirectional_tracer.h"
#include "montecarlo/integrators.h"
#include "montecarlo/light_tracer.h"
#include "tests/montecarlo/rooms.h"
#include "tests/montecarlo/statistics.h"

// What every integrator that finds all paths keeps, whoever comes to the catalogue.
namespace interflect::montecarlo {
namespace {

using scene::SceneBuilder;
using test::at_point;
using test::Question;
using test::whole;

const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();

class EveryIntegrator : public testing::TestWithParam<std::string> {
 protected:
  std::unique_ptr<measure::Method> integrator(std::uint64_t samples, const std::string& intersector = "embree") const {
    IntegratorSettings settings;
    settings.samples = samples;
    settings.intersector = intersector;
    return make_integrator(GetParam(), settings);
  }
  std::unique_ptr<measure::Method> of_paths(std::uint64_t samples, const std::string& paths) const {
    IntegratorSettings settings;
    settings.samples = samples;
    settings.paths = measure::PathClasses::of(paths);
    return make_integrator(GetParam(), settings);
  }
  bool by_chance() const { return integrator_entry(GetParam()).by_chance; }
  /// A sample of light tracing is a path for all that is asked, of the others one for each.
  std::uint64_t samples(std::uint64_t of_each) const { return GetParam() == "light" ? 8 * of_each : of_each; }
};

/// Truths: docs/truths.md, V1, by quadrature to 1e-10.  A diagonal cuts a square into two patches that are each other's
/// mirror images, and so is what arrives there: on either as much as on both.
std::vector<Question> questions_of(const scene::Scene& scene) {
  const double bright = .100947189239, dark = .010218055060, at_quarter = .104998409669;
  const auto half = [&](const char* name) {
    const auto halves = measure::patches_of(scene, test::surface_named(scene, name), scene::Side::front);
    EXPECT_EQ(halves.size(), 2u);
    return measure::PatchIrradiance{halves[0]};
  };
  return {whole(scene, "upper", bright / .5),
          whole(scene, "lower", dark / .5),
          {half("upper"), test::grey(bright / .5), "half of upper"},
          {half("lower"), test::grey(dark / .5), "half of lower"},
          at_point({.25, .25, 1}, -z, at_quarter / .5, test::surface_named(scene, "upper")),
          {measure::PixelRadiance{{0}, 0, 0}, test::grey(bright * inv_pi), "pixel"}};
}

/// How many of n intervals of 95 % miss the truth: binomial, fewer and more with no more than this probability each.
struct Misses {
  int fewest = 0, most = 0;

  Misses(int n, double level) {
    constexpr double miss = .05;
    double each = std::pow(1 - miss, n), up_to = each;  // of k misses, and of no more
    for (int k = 0; 1 - up_to > level; ++k) {
      if (up_to <= level) fewest = k + 1;
      each *= (n - k) * miss / ((k + 1) * (1 - miss));
      up_to += each;
      most = k + 1;
    }
  }
};

// 95 % intervals hold the truth as often as that: of 500 seeds all but 8 .. 46 do.  Fewer misses would be wrong too, as
// intervals that are too wide have none.  Of samples so many, and to a target, by pilots that are thrown away: twelve
// counts of an integrator, with two ends each.  (In 200 seeds, by 181 .. 197, one of twelve would be outside by chance with
// a probability of .06.)
TEST_P(EveryIntegrator, holds_the_truth_as_often_as_it_says) {
  constexpr int seeds = 500;
  const scene::Scene scene = test::facing_squares();
  const std::vector<Question> questions = questions_of(scene);
  std::vector<measure::Measurement> asked;
  for (const Question& question : questions) asked.push_back(question.asked);
  IntegratorSettings to_a_target;
  to_a_target.target = .05;
  test::Family family(2 * 2 * questions.size());
  for (const bool to_target : {false, true}) {
    const auto method = to_target ? make_integrator(GetParam(), to_a_target) : integrator(samples(1000));
    std::vector<int> missed(asked.size());
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      core::LocalRun run(seed, 2);
      const auto found = method->answer(scene, asked, run.get());
      for (std::size_t m = 0; m < asked.size(); ++m)
        missed[m] += std::abs(found[m].value[0] - questions[m].truth[0]) > normal_95 * found[m].standard_error[0];
    }
    for (std::size_t m = 0; m < asked.size(); ++m) {
      const Misses may_be(seeds, family.level(2));
      EXPECT_GE(missed[m], may_be.fewest) << questions[m].name << (to_target ? " to a target" : "");
      EXPECT_LE(missed[m], may_be.most) << questions[m].name << (to_target ? " to a target" : "");
    }
  }
}

// In double precision, facet by facet, rays meet the same.
TEST_P(EveryIntegrator, agrees_with_itself_by_rays_in_double_precision) {
  if (by_chance()) GTEST_SKIP() << "known as well only by ten times the samples: brute.cpp";
  const scene::Scene scene = test::furnished(1);
  const std::vector<measure::Measurement> asked{
      measure::Flux{measure::patches_of(scene, test::surface_named(scene, "floor"), scene::Side::front)},
      measure::Flux{measure::patches_of(scene, test::surface_named(scene, "block/x-"), scene::Side::front)},
      measure::PointIrradiance{Vec3(.5, 1, .4), Vec3(.6, 0, .8), {}}, measure::PixelRadiance{{0}, 3, 2}};
  test::expect_same(*integrator(samples(10'000), "brute"), *integrator(samples(10'000)), scene, asked, .1);
}

// Two runs of the same seed by one and by many threads.
TEST_P(EveryIntegrator, has_the_same_bits_for_any_number_of_threads) {
  const scene::Scene scene = test::furnished(1);
  const std::vector<measure::Measurement> asked{
      measure::Flux{measure::patches_of(scene, test::surface_named(scene, "floor"), scene::Side::front)},
      measure::PointIrradiance{Vec3(.5, 1, .4), z, {}}, measure::PixelRadiance{{0}, 2, 2},
      measure::PixelRadiance{{0}, 3, 2}, measure::PixelRadiance{{0}, 2, 2}};
  std::vector<std::vector<Estimate>> found;
  for (const unsigned threads : {1u, 2u, 3u, 8u}) {
    core::LocalRun run(7, threads);
    found.push_back(integrator(samples(2'000))->answer(scene, asked, run.get()));
  }
  for (const auto& each : found)
    for (std::size_t m = 0; m < asked.size(); ++m) {
      EXPECT_EQ(each[m].value, found[0][m].value);
      EXPECT_EQ(each[m].standard_error, found[0][m].standard_error);
    }
  if (GetParam() != "path" && GetParam() != "unidirectional") {
    EXPECT_EQ(found[0][2].value, found[0][4].value);  // asked twice, of one film
  }
}

TEST_P(EveryIntegrator, finds_a_dark_scene_dark_and_stops) {
  SceneBuilder builder({"grey"});
  builder.add_box("room", {Vec3(0, 0, 0), Vec3(1, 2, 3)}, builder.add_material(test::diffuse("wall", .5, 0)),
                  SceneBuilder::Facing::inward);
  const scene::Scene scene = builder.finish();
  core::LocalRun run(1);
  IntegratorSettings to_a_target;
  const auto found = make_integrator(GetParam(), to_a_target)
                         ->answer(scene, std::vector<measure::Measurement>{test::all_fronts(scene)}, run.get());
  EXPECT_EQ(found[0].value[0], 0);
  EXPECT_EQ(found[0].standard_error[0], 0);
}

// In a furnace of E = 1 - rho what comes after k reflections is E rho^k: to all kinds of measurements, k by k.
TEST_P(EveryIntegrator, knows_paths_by_their_length) {
  constexpr double rho = .6;
  SceneBuilder builder({"grey"});
  const auto wall = builder.add_material(test::diffuse("wall", rho, 1 - rho));
  builder.add_box("room", {Vec3(0, 0, 0), Vec3(2, 3, 1)}, wall, SceneBuilder::Facing::inward);
  builder.scene().cameras.push_back({"c", Vec3(.9, 1.2, .4), Vec3(1.5, 2.8, .7), z, 90, 1, 1});
  const scene::Scene scene = builder.finish();
  const auto side = measure::patches_of(scene, test::surface_named(scene, "room/x-"), scene::Side::front);
  std::string scattered;
  for (int k = 0; k < 5; ++k) {
    const bool rest = k == 4;
    const double truth = rest ? std::pow(rho, k) : (1 - rho) * std::pow(rho, k);
    test::expect_agreement(*of_paths(samples(50'000), "A" + scattered + (rest ? "D*E" : "E")), scene,
                           {{measure::Flux{side}, test::grey(3 * truth), "flux"},
                            {measure::PatchIrradiance{side[0]}, test::grey(truth), "patch"},
                            at_point(Vec3(1, 1, .5), z, truth),
                            {measure::PixelRadiance{{0}, 0, 0}, test::grey(truth * inv_pi), "pixel"}},
                           .1, static_cast<std::uint64_t>(k + 1));
    scattered += "D";
  }
}

// In a room of every material, class by class, as path tracing finds them.
TEST_P(EveryIntegrator, agrees_with_path_tracing_class_by_class) {
  if (by_chance()) GTEST_SKIP() << "known as well only by ten times the samples: unidirectional.cpp";
  const scene::Scene scene = test::shiny();
  std::vector<measure::Measurement> asked{
      measure::Flux{measure::patches_of(scene, test::surface_named(scene, "room/z-"), scene::Side::front)},
      measure::Flux{measure::patches_of(scene, test::surface_named(scene, "plastic/z+"), scene::Side::front)}};
  if (GetParam() != "light") asked.push_back(measure::PointIrradiance{Vec3(.3, 1, .4), Vec3(.6, 0, .8), {}});
  for (const char* paths : {"AE", "AS.*E", "AD(D|G)*E", "A.*G.*D.*E"})
    test::expect_same(*of_paths(samples(200'000), paths),
                      PathTracer({.samples = 250'000, .paths = measure::PathClasses::of(paths)}), scene, asked, .2);
}

// By the same samples: what comes first after the light is one of four.
TEST_P(EveryIntegrator, adds_parts_of_all_paths_up_to_the_whole) {
  const scene::Scene scene = test::shiny();
  const std::vector<measure::Measurement> asked{
      measure::Flux{measure::patches_of(scene, test::surface_named(scene, "room/z-"), scene::Side::front)},
      measure::PointIrradiance{Vec3(.3, 1, .4), Vec3(.6, 0, .8), {}}, measure::PixelRadiance{{0}, 1, 1}};
  const measure::Capabilities finds = integrator(1)->capabilities();
  const measure::PathClasses all = finds.to_patches & finds.to_points & finds.to_pixels;
  const auto found_of = [&](const measure::PathClasses& paths) {
    IntegratorSettings settings;
    settings.samples = samples(5'000);
    settings.paths = paths;
    core::LocalRun run(1, 2);
    return make_integrator(GetParam(), settings)->answer(scene, asked, run.get());
  };
  std::vector<Spectrum> sums(asked.size());
  std::vector<int> parts(asked.size());
  for (const char* part : {"LE", "LD.*E", "LG.*E", "LS.*E"}) {
    const auto found = found_of(all & measure::PathClasses::of(part));
    for (std::size_t m = 0; m < asked.size(); ++m) {
      sums[m] += found[m].value;
      if (!found[m].value.is_zero()) ++parts[m];
    }
  }
  const auto whole = found_of(all);
  for (std::size_t m = 0; m < asked.size(); ++m) {
    EXPECT_GE(parts[m], 3) << m;  // no light straight into the pixel
    for (int c = 0; c < scene.channel_count(); ++c)
      EXPECT_NEAR(sums[m][c], whole[m].value[c], 1e-12 * whole[m].value[c]) << m << ' ' << c;
  }
}

std::vector<std::string> that_find_all_light_of_lamps() { return {"path", "unidirectional", "bidirectional", "light"}; }

INSTANTIATE_TEST_SUITE_P(Catalogue, EveryIntegrator, testing::ValuesIn(that_find_all_light_of_lamps()),
                         [](const auto& of) { return of.param; });

/// A point over a mirror and a floor.
scene::Scene point_and_mirror() {
  SceneBuilder builder({"grey"});
  scene::Material mirror;
  mirror.finish = scene::Mirror{test::grey(.8)};
  builder.add_polygon("mirror", test::parallelogram(Vec3::Zero(), x, y), builder.add_material(mirror));
  builder.add_polygon("floor", test::parallelogram(x, x, y), builder.add_material(test::diffuse("floor", .5, 0)));
  builder.add_polygon("ceiling", test::parallelogram(z, y, 2 * x), builder.add_material(test::diffuse("c", .5, 0)));
  builder.scene().lights.points.push_back({"p", Vec3(.5, .5, .5), test::grey(1)});
  builder.scene().cameras.push_back({"c", Vec3(1.5, .5, .5), Vec3(.5, .5, 0), z, 60, 2, 2});
  return builder.finish();
}

// What nobody would find is not left out without a word.
TEST(Integrators, refuse_what_they_would_miss_and_say_how_to_leave_it_out) {
  const scene::Scene scene = point_and_mirror();
  const measure::Measurement patch{
      measure::Flux{measure::patches_of(scene, test::surface_named(scene, "ceiling"), scene::Side::front)}},
      point{measure::PointIrradiance{Vec3(1.5, .5, .2), z, {}}}, pixel{measure::PixelRadiance{{0}, 0, 0}};
  const auto refusal = [&](const char* name, const measure::Measurement& asked, const char* paths = "L.*E") {
    core::LocalRun run(1);
    IntegratorSettings settings;
    settings.samples = 100;
    settings.paths = measure::PathClasses::of(paths);
    try {
      make_integrator(name, settings)->answer(scene, {&asked, 1}, run.get());
      return std::string();
    } catch (const core::InputError& error) {
      return std::string(error.what());
    }
  };
  for (const measure::Measurement& asked : {patch, point, pixel})
    EXPECT_NE(refusal("path", asked).find("from a point or spot, by a mirror"), std::string::npos)
        << refusal("path", asked);
  EXPECT_EQ(refusal("light", patch), "");
  EXPECT_NE(refusal("light", point).find("paths PSE "), std::string::npos) << refusal("light", point);
  EXPECT_NE(refusal("light", pixel).find(", by a mirror"), std::string::npos) << refusal("light", pixel);
  EXPECT_EQ(refusal("bidirectional", patch), "");
  EXPECT_NE(refusal("bidirectional", point).find("paths PSE "), std::string::npos);
  EXPECT_NE(refusal("bidirectional", pixel).find("paths PSDSE "), std::string::npos) << refusal("bidirectional", pixel);
  // As the message says.
  EXPECT_EQ(refusal("path", pixel, "(A|F).*E|PE|P(D|G).*E"), "");
  EXPECT_EQ(refusal("light", point, "L(.*(D|G))?E"), "");
  EXPECT_EQ(refusal("bidirectional", pixel, "(A|F).*E|PE|P(D|G).*E|P.*(D|G)(D|G).*E|P.*(D|G)E"), "");
}

// And what is asked without that is the same by all.
TEST(Integrators, agree_on_what_all_find) {
  const scene::Scene scene = point_and_mirror();
  const std::vector<measure::Measurement> asked{
      measure::Flux{measure::patches_of(scene, test::surface_named(scene, "ceiling"), scene::Side::front)},
      measure::PointIrradiance{Vec3(1.5, .5, .2), z, {}}, measure::PixelRadiance{{0}, 1, 1}};
  const auto paths = measure::PathClasses::of("PD.*DE|PDE|PD");
  test::expect_same(BidirectionalTracer({.samples = 100'000, .paths = paths}),
                    PathTracer({.samples = 100'000, .paths = paths}), scene, asked, .05);
  test::expect_same(LightTracer({.samples = 1'000'000, .paths = paths}),
                    PathTracer({.samples = 100'000, .paths = paths}), scene, asked, .05);
}

}  // namespace
}  // namespace interflect::montecarlo

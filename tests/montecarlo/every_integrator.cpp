#include "montecarlo/integrators.h"
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
  /// A sample of light tracing is a path for all that is asked, of the others one for each.
  std::uint64_t samples(std::uint64_t of_each) const { return GetParam() == "light" ? 8 * of_each : of_each; }
};

/// Two unit squares that face each other, the lower one bright; a camera between them that sees the whole upper one.
/// Truths: docs/truths.md, V1, by quadrature to 1e-10.
scene::Scene squares() {
  SceneBuilder builder({"grey"});
  builder.add_polygon("upper", test::parallelogram(z, y, x), builder.add_material(test::diffuse("upper", .5, 0)));
  builder.add_polygon("lower", test::parallelogram(Vec3::Zero(), x, y),
                      builder.add_material(test::diffuse("lower", .5, 1)));
  builder.scene().cameras.push_back(
      {"c", Vec3(.5, .5, .5), Vec3(.5, .5, 1), x, scene::Projection(scene::Orthographic{1}), 1, 1});
  return builder.finish();
}

std::vector<Question> questions_of(const scene::Scene& scene) {
  const double bright = .100947189239, dark = .010218055060, at_quarter = .104998409669;
  const auto lower = measure::patches_of(scene, test::surface_named(scene, "lower"), scene::Side::front);
  return {whole(scene, "upper", bright / .5),
          whole(scene, "lower", dark / .5),
          at_point({.25, .25, 1}, -z, at_quarter / .5, test::surface_named(scene, "upper")),
          {measure::PixelRadiance{{0}, 0, 0}, test::grey(bright * inv_pi), "pixel"}};
}

// Of 200 seeds, 95 % intervals hold the truth in 181 .. 197 with a probability of .99, of each measurement.
TEST_P(EveryIntegrator, holds_the_truth_as_often_as_it_says) {
  const scene::Scene scene = squares();
  const std::vector<Question> questions = questions_of(scene);
  std::vector<measure::Measurement> asked;
  for (const Question& question : questions) asked.push_back(question.asked);
  std::vector<int> held(asked.size());
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    core::LocalRun run(seed, 2);
    const auto found = integrator(samples(1000))->answer(scene, asked, run.get());
    for (std::size_t m = 0; m < asked.size(); ++m)
      held[m] += std::abs(found[m].value[0] - questions[m].truth[0]) <= normal_95 * found[m].standard_error[0];
  }
  for (std::size_t m = 0; m < asked.size(); ++m) {
    EXPECT_GE(held[m], 181) << questions[m].name;
    EXPECT_LE(held[m], 197) << questions[m].name;
  }
}

// In double precision, facet by facet, rays meet the same.
TEST_P(EveryIntegrator, agrees_with_itself_by_rays_in_double_precision) {
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
      measure::PointIrradiance{Vec3(.5, 1, .4), z, {}}, measure::PixelRadiance{{0}, 2, 2}};
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

std::vector<std::string> that_find_all_paths() { return {"path", "bidirectional", "light"}; }

INSTANTIATE_TEST_SUITE_P(Catalogue, EveryIntegrator, testing::ValuesIn(that_find_all_paths()),
                         [](const auto& of) { return of.param; });

}  // namespace
}  // namespace interflect::montecarlo

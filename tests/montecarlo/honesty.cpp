#include <array>

#include "core/format.h"
#include "tests/montecarlo/statistics.h"
#include "tests/montecarlo/stopping_caster.h"
#include "tests/support/shapes.h"

// What the path tracer says of itself: standard errors, targets, repeatability, interruption.
namespace interflect::montecarlo {
namespace {

using scene::SceneBuilder;

/// Two unit squares, rho 1/2, the lower emits 1 (docs/truths.md 2.4).
scene::Scene plates() {
  SceneBuilder builder({"grey"});
  builder.add_polygon("lower", {{Vec3(-.5, -.5, 0), Vec3(.5, -.5, 0), Vec3(.5, .5, 0), Vec3(-.5, .5, 0)}, {}},
                      builder.add_material(test::diffuse("l", 0.5, 1)));
  builder.add_polygon("upper", {{Vec3(-.5, .5, 1), Vec3(.5, .5, 1), Vec3(.5, -.5, 1), Vec3(-.5, -.5, 1)}, {}},
                      builder.add_material(test::diffuse("u", 0.5, 0)));
  builder.scene().cameras.push_back({"eye", Vec3(0, 0, 0.5), Vec3(0, 0, 1), Vec3::UnitX(), 40, 4, 4});
  return builder.finish();
}

/// A bright element, a dark one (its light all reflected), a point, a flux; with their truths.
std::vector<test::Question> plate_questions(const scene::Scene& scene) {
  const auto quad = [&](const char* name, bool up) {
    const auto id = test::surface_named(scene, name);
    const auto& outline = *scene.surface(id).outline;
    EXPECT_EQ(up, name[0] == 'l');
    return measure::PatchIrradiance{scene::make_patch(id, scene::Side::front, outline.outer)};
  };
  return {{quad("upper", false), test::grey(0.100947189239 / 0.5), "bright"},
          {quad("lower", true), test::grey(0.010218055060 / 0.5), "dark"},
          test::at_point({.25, .25, 1}, -Vec3::UnitZ(), 0.104998409669 / 0.5, test::surface_named(scene, "upper")),
          test::whole(scene, "upper", 0.100947189239 / 0.5)};
}

std::vector<measure::Measurement> asked_of(const std::vector<test::Question>& questions) {
  std::vector<measure::Measurement> asked;
  for (const auto& question : questions) asked.push_back(question.asked);
  return asked;
}

/// How often, in 200 runs, an interval of 95 % may hold the truth.  The number is binomial (200, 0.95): below 181 with
/// probability 2.7e-3, above 197 with 2.3e-3.  So eight comparisons (four measurements in two modes) fail by chance
/// with probability 0.04.  The upper limit matters too: standard errors that are too large would always hold it.
constexpr int fewest_covered = 181, most_covered = 197;

TEST(PathTracer, holds_the_truth_in_its_95_percent_intervals_in_95_percent_of_runs) {
  const scene::Scene scene = plates();
  const auto questions = plate_questions(scene);
  const auto asked = asked_of(questions);
  for (const PathTracerSettings& settings : {PathTracerSettings{.samples = 1024}, PathTracerSettings{.target = 0.03}}) {
    std::array<int, 4> covered{};
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
      core::LocalRun run(seed);
      const auto found = PathTracer(settings).answer(scene, asked, run);
      for (std::size_t i = 0; i < found.size(); ++i)
        covered[i] += std::abs(found[i].value[0] - questions[i].truth[0]) < normal_95 * found[i].standard_error[0];
    }
    for (std::size_t i = 0; i < covered.size(); ++i) {
      EXPECT_GE(covered[i], fewest_covered) << questions[i].name << " samples " << settings.samples;
      EXPECT_LE(covered[i], most_covered) << questions[i].name << " samples " << settings.samples;
    }
  }
}

// One half of the lower plate shines in one channel, the other half in the other: a sample that finds one lamp misses
// the other, and the noise of the mean of both channels is well below the mean of their noises.
TEST(PathTracer, tells_the_noise_of_the_weighted_value_as_it_is) {
  SceneBuilder builder({"a", "b"});
  for (const int c : {0, 1}) {
    scene::Material lamp;
    lamp.exitance[c] = 1;
    const double x = 0.5 * c;
    builder.add_polygon("lamp", {{Vec3(x, 0, 0), Vec3(x + .5, 0, 0), Vec3(x + .5, 1, 0), Vec3(x, 1, 0)}, {}},
                        builder.add_material(lamp));
  }
  builder.add_polygon("upper", {{Vec3(0, 0, 1), Vec3(0, 1, 1), Vec3(1, 1, 1), Vec3(1, 0, 1)}, {}},
                      builder.add_material(scene::Material{}));
  const scene::Scene scene = builder.finish();
  const std::vector<measure::Measurement> asked{test::whole(scene, "upper", 0).asked};
  const double truth = 0.199824895698 / 2;  // docs/truths.md 2.11, V1, half of it in each channel; weights 1/2
  int covered = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    core::LocalRun run(seed);
    const Estimate found = PathTracer({.samples = 1024}).answer(scene, asked, run)[0];
    covered += std::abs(scene.weigh(found.value) - truth) < normal_95 * found.weighed_standard_error;
    EXPECT_LT(found.weighed_standard_error, 0.8 * scene.weigh(found.standard_error));
  }
  EXPECT_GE(covered, fewest_covered);
  EXPECT_LE(covered, most_covered);
}

bool same_bits(const Estimate& a, const Estimate& b) {
  return a.value == b.value && a.standard_error == b.standard_error && a.samples == b.samples;
}

TEST(PathTracer, gives_the_same_bits_for_any_number_of_threads) {
  const scene::Scene scene = plates();
  auto asked = asked_of(plate_questions(scene));
  asked.push_back(measure::PixelRadiance{{0}, 1, 2});
  for (const char* intersector : {"embree", "brute"})
    for (const PathTracerSettings& settings : {PathTracerSettings{.samples = 5001, .intersector = intersector},
                                               PathTracerSettings{.target = 0.02, .intersector = intersector}}) {
      core::LocalRun one(7, 1);
      const auto expected = PathTracer(settings).answer(scene, asked, one);
      for (unsigned threads : {2u, 3u, 8u}) {
        core::LocalRun run(7, threads);
        const auto found = PathTracer(settings).answer(scene, asked, run);
        for (std::size_t i = 0; i < found.size(); ++i)
          EXPECT_TRUE(same_bits(found[i], expected[i])) << threads << ' ' << i;
      }
      core::LocalRun other(8, 1);
      EXPECT_FALSE(same_bits(PathTracer(settings).answer(scene, asked, other)[0], expected[0]));
    }
}

// Between 0.7 and 1.05 of the target: n has a margin of 1.5 for the noise of the pilot's own s², and 1 / sqrt(1.5) =
// 0.82.
TEST(PathTracer, reaches_its_target_and_does_not_waste_samples) {
  const scene::Scene scene = plates();
  core::LocalRun run(3);
  const auto asked = asked_of(plate_questions(scene));
  const auto found = PathTracer({.target = 0.01, .target_floor = 0}).answer(scene, asked, run);
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_LT(found[i].standard_error[0], 0.0105 * found[i].value[0]) << i;
    EXPECT_GT(found[i].standard_error[0], 0.007 * found[i].value[0]) << i;
  }
  for (const Estimate& e : PathTracer({.target = 10}).answer(scene, asked, run)) EXPECT_EQ(e.samples, 4096u);
}

// n = 1.5 s² / (3e-4 mean)², and s is half the mean here: 4 million samples.  Neither does a cap end them silently, nor
// a floor that would not shrink with the target.
TEST(PathTracer, reaches_a_target_of_millions_of_samples) {
  const scene::Scene scene = plates();
  core::LocalRun run(3);
  const std::vector<measure::Measurement> asked{asked_of(plate_questions(scene))[2]};
  const Estimate found = PathTracer({.target = 3e-4}).answer(scene, asked, run)[0];
  EXPECT_LT(found.standard_error[0], 3e-4 * found.value[0]);
  EXPECT_GT(found.samples, 2u << 20);
}

TEST(PathTracer, says_in_one_line_which_targets_it_did_not_reach) {
  const scene::Scene scene = plates();
  core::LocalRun run(3);
  const auto asked = asked_of(plate_questions(scene));
  testing::internal::CaptureStderr();
  const auto capped = PathTracer({.target = 0.001, .target_floor = 0, .max_samples = 3000}).answer(scene, asked, run);
  const std::string said = testing::internal::GetCapturedStderr();
  double worst = 0;
  for (const Estimate& e : capped) {
    EXPECT_EQ(e.samples, 3000u);
    worst = std::max(worst, 100 * e.standard_error[0] / e.value[0]);
  }
  EXPECT_NE(said.find(core::format("4 of 4 measurements stopped at 3000 samples, the worst at %.2g %% where 0.1 %% was "
                                   "asked for",
                                   worst)),
            std::string::npos)
      << said;
  // Nothing is said where the target was reached at the cap, or where a number of samples was given.
  testing::internal::CaptureStderr();
  PathTracer({.target = 0.5, .max_samples = 3000}).answer(scene, asked, run);
  PathTracer({.samples = 3000, .target = 0.001, .max_samples = 3000}).answer(scene, asked, run);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(PathTracer, ends_in_scenes_without_light_and_calls_them_exactly_dark) {
  SceneBuilder builder({"grey"});
  builder.add_box("room", {Vec3(0, 0, 0), Vec3(1, 1, 1)}, builder.add_material(test::diffuse("m", 0.9, 0)),
                  SceneBuilder::Facing::inward);
  const scene::Scene scene = builder.finish();
  core::LocalRun run;
  const std::vector<measure::Measurement> asked{test::all_fronts(scene)};
  const auto found = PathTracer().answer(scene, asked, run);
  EXPECT_EQ(found[0].value[0], 0);
  EXPECT_EQ(found[0].standard_error[0], 0);
  EXPECT_EQ(found[0].samples, 0u);
  EXPECT_EQ(PathTracer().forecast(scene, asked, run), 0);
}

// A room whose only lamp is in another room: no sample can score, but the samples alone do not prove it.
TEST(PathTracer, does_not_claim_to_know_that_nothing_arrives_where_nothing_was_found) {
  SceneBuilder builder({"grey", "blue"});
  scene::Material lamp = test::diffuse("lamp", 0, 5);
  builder.add_box("lit", {Vec3(0, 0, 0), Vec3(1, 1, 1)}, builder.add_material(lamp), SceneBuilder::Facing::inward);
  builder.add_box("dark", {Vec3(2, 0, 0), Vec3(3, 1, 1)}, builder.add_material(test::diffuse("m", 0.5, 0)),
                  SceneBuilder::Facing::inward);
  const scene::Scene scene = builder.finish();
  core::LocalRun run;
  const std::vector<measure::Measurement> asked{test::whole(scene, "dark/z-", 0).asked};
  const auto found = PathTracer({.samples = 1000}).answer(scene, asked, run);
  EXPECT_EQ(found[0].value[0], 0);
  EXPECT_DOUBLE_EQ(found[0].standard_error[0], 3 * 2 * 5 / 1000.0);  // area 1; two techniques
  EXPECT_EQ(found[0].standard_error[1], 0);                          // no blue light anywhere
  // By a target: as many as bring 3 w / n to the floor, 1e-3 of Phi / sum A (1 - rho) = 30 / (6 + 3) in channel grey;
  // the weights, one half each, cancel up to the dark channel's reflectance: sum A (1 - rho) = 6 + 6 (1 - 0.25).
  const auto aimed = PathTracer().answer(scene, asked, run);
  EXPECT_NEAR(static_cast<double>(aimed[0].samples), 3 * 0.5 * 10 / (1e-3 * 0.5 * 30 / 10.5), 2);
}

TEST(PathTracer, throws_when_stopped_before_it_begins_and_answers_with_less_when_stopped_later) {
  const scene::Scene scene = plates();
  const auto questions = plate_questions(scene);
  const auto asked = asked_of(questions);
  std::stop_source source;
  core::LocalRun run(1, 1);
  run.get().stop = source.get_token();
  const test::StoppingCaster caster(scene, source, 100'000);  // some rays a sample, 1024 samples a round
  const auto found = PathTracer({.samples = 1u << 30}).answer(scene, asked, run, caster);
  const double limit = test::critical_z(test::alpha, found.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_GE(found[i].samples, 2u);
    EXPECT_LE(found[i].samples, 100'000u);
    EXPECT_LT(std::abs(found[i].value[0] - questions[i].truth[0]), limit * found[i].standard_error[0]);
  }
  EXPECT_THROW(PathTracer({.samples = 1000}).answer(scene, asked, run), core::Interrupted);
  EXPECT_THROW(PathTracer().answer(scene, asked, run), core::Interrupted);
}

TEST(PathTracer, refuses_in_one_line_what_cannot_be_measured) {
  const scene::Scene scene = plates();
  core::LocalRun run;
  const auto refuses = [&](const measure::Measurement& m, const PathTracerSettings& settings) {
    const std::vector<measure::Measurement> asked{m};
    EXPECT_THROW(PathTracer(settings).answer(scene, asked, run), core::InputError);
  };
  const measure::PixelRadiance pixel{{0}, 1, 1};
  refuses(measure::PixelRadiance{{1}, 0, 0}, {});
  refuses(measure::PixelRadiance{{0}, 4, 0}, {});
  refuses(measure::PointIrradiance{Vec3(0, 0, 0), Vec3(0, 0, 2), {}}, {});
  const std::array<Vec3, 3> line{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0)};
  refuses(measure::PatchIrradiance{scene::make_patch({0}, scene::Side::front, line)}, {});
  refuses(measure::Flux{}, {});
  refuses(pixel, {.samples = 1});
  refuses(pixel, {.target = 0});
  refuses(pixel, {.intersector = "none"});
}

// What a forecast of time rests on.  100 measurements of four kinds, of which 64 are tried: as many of each kind, and
// pilots of 10^4 samples that know s² to a few percent.  (Seconds are those samples at the speed of the trial.)
TEST(PathTracer, forecasts_how_many_samples_it_will_take) {
  const scene::Scene scene = plates();
  std::vector<measure::Measurement> asked;
  for (int i = 0; i < 25; ++i)
    for (const auto& m : asked_of(plate_questions(scene))) asked.push_back(m);
  core::LocalRun run;
  for (const PathTracerSettings& settings : {PathTracerSettings{.target = 0.01}, PathTracerSettings{.samples = 500}}) {
    const PathTracer tracer(settings);
    double taken = 0;
    for (const Estimate& e : tracer.answer(scene, asked, run)) taken += static_cast<double>(e.samples);
    EXPECT_NEAR(tracer.forecast_samples(scene, asked, run) / taken, 1, 0.05);
    EXPECT_GT(tracer.forecast(scene, asked, run), 0);
  }
}

}  // namespace
}  // namespace interflect::montecarlo

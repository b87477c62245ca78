#include "montecarlo/integrator_comparison.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/moments.h"
#include "tests/montecarlo/rooms.h"
#include "tests/montecarlo/statistics.h"

namespace interflect::montecarlo {
namespace {

using scene::SceneBuilder;

constexpr double reflects = .8;

/// A point of flux 1, 1 above a square mirror of side 1, under a black ceiling so wide that it meets all that is
/// reflected.
scene::Scene point_over_a_mirror() {
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  SceneBuilder builder({"grey"});
  scene::Material mirror;
  mirror.finish = scene::Mirror{test::grey(reflects)};
  builder.add_polygon("mirror", test::parallelogram(Vec3(-.5, -.5, 0), x, y), builder.add_material(mirror));
  const auto black = builder.add_material(test::diffuse("black", 0, 0));
  builder.add_polygon("ceiling", test::parallelogram(Vec3(-5, -5, 1.5), 10 * y, 10 * x), black);
  builder.scene().lights.points.push_back({"p", z, test::grey(1 / (4 * pi))});
  builder.scene().cameras.push_back({"c", Vec3(0, 0, 1.2), Vec3(0, 0, 1.5), x, 60, 1, 1});
  return builder.finish();
}

std::vector<measure::Measurement> ceiling_of(const scene::Scene& scene) {
  return {measure::Flux{measure::patches_of(scene, test::surface_named(scene, "ceiling"), scene::Side::front)}};
}

// Light tracing finds what the mirror sends up, R times its solid angle over 4 pi, asin(1/5) / pi; path tracing does not:
// they are held against each other without it.
TEST(IntegratorComparison, holds_each_pair_against_each_other_on_what_both_find) {
  const scene::Scene scene = point_over_a_mirror();
  IntegratorSettings settings;
  settings.samples = 200'000;
  core::LocalRun run(1, 2);
  const auto comparison = compare_integrators(scene, ceiling_of(scene), {"path", "light"}, settings, run.get());
  ASSERT_EQ(comparison.trials.size(), 2u);
  EXPECT_EQ(comparison.trials[0].missed, "PSE");
  EXPECT_EQ(comparison.trials[1].missed, "");
  ASSERT_EQ(comparison.pairs.size(), 1u);
  const IntegratorPair& pair = comparison.pairs[0];
  EXPECT_FALSE(pair.common.contains("PSE"));
  EXPECT_TRUE(pair.common.contains("PE"));
  EXPECT_EQ(pair.of_a[0].value, comparison.trials[0].found[0].value);  // not once more
  const auto apart = [](const Estimate& a, const Estimate& b) {
    return std::make_pair(a.value[0] - b.value[0], 4 * std::hypot(a.standard_error[0], b.standard_error[0]));
  };
  const auto [differ, noise] = apart(pair.of_a[0], pair.of_b[0]);
  EXPECT_NEAR(differ, 0, noise);
  const auto [mirrored, of_both] = apart(comparison.trials[1].found[0], pair.of_b[0]);
  EXPECT_NEAR(mirrored, reflects * std::asin(.2) / pi, of_both);
  EXPECT_LT(of_both, .01);
}

// Each by itself finds the mean of the main run, all together as well as it does; nothing is drawn by two of them.
TEST(IntegratorComparison, replicates_by_runs_of_other_seeds) {
  const scene::Scene scene = point_over_a_mirror();
  IntegratorSettings settings;
  settings.samples = 64'000;
  core::LocalRun run(1, 2);
  const std::vector<std::string> names{"path", "light", "whitted"};
  settings.paths = measure::PathClasses::of("PE");
  const auto comparison =
      compare_integrators(scene, ceiling_of(scene), names, settings, run.get(), {.replications = 32});
  ASSERT_EQ(comparison.pairs.size(), 3u);
  for (const IntegratorPair& pair : comparison.pairs)
    for (const auto& [found, again, name] :
         {std::tuple{pair.of_a[0], pair.again_a, names[pair.a]}, {pair.of_b[0], pair.again_b, names[pair.b]}}) {
      ASSERT_EQ(again.size(), 32u);
      core::ScalarMoments means;
      for (const std::vector<Estimate>& each : again) means.add(each[0].value[0]);
      if (name == "whitted") {
        EXPECT_EQ(means.mean(), found.value[0]);
        continue;
      }
      EXPECT_EQ(again[0][0].samples, 2000u);
      EXPECT_NE(again[0][0].value[0], again[1][0].value[0]);
      EXPECT_NEAR(means.mean(), found.value[0], 5 * std::hypot(means.standard_error(), found.standard_error[0]))
          << name;
      EXPECT_GT(means.standard_error(), .5 * found.standard_error[0]);
      EXPECT_LT(means.standard_error(), 2 * found.standard_error[0]);
    }
}

// Path tracing finds less than two others: they are asked for what it finds once each, the third pair for what it has.
TEST(IntegratorComparison, asks_once_for_what_several_pairs_have_in_common) {
  const scene::Scene scene = point_over_a_mirror();
  IntegratorSettings settings;
  settings.samples = 2000;
  core::LocalRun run(1, 2);
  const auto comparison = compare_integrators(scene, ceiling_of(scene), {"path", "light", "distributed"}, settings,
                                              run.get(), {.replications = 4});
  ASSERT_EQ(comparison.pairs.size(), 3u);
  const IntegratorPair &with_path = comparison.pairs[0], &with_distributed = comparison.pairs[2];
  ASSERT_EQ(comparison.trials[2].missed, "PSE");
  EXPECT_EQ(with_path.of_b[0].value, with_distributed.of_a[0].value);
  EXPECT_NE(with_path.of_b[0].value, comparison.trials[1].found[0].value);
  ASSERT_EQ(with_path.again_b.size(), 4u);
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_EQ(with_path.again_b[k][0].value, with_distributed.again_a[k][0].value) << k;
  const ComparisonTimes& took = comparison.times;
  EXPECT_GT(took.measuring, 0);
  EXPECT_GT(took.on_common_paths, 0);
  EXPECT_GT(took.replications, 0);
  double of_trials = 0;
  for (const IntegratorTrial& trial : comparison.trials) of_trials += trial.processor_seconds;
  EXPECT_DOUBLE_EQ(took.measuring, of_trials);
}

TEST(IntegratorComparison, asks_nobody_for_what_it_does_not_find) {
  const scene::Scene scene = point_over_a_mirror();
  IntegratorSettings settings;
  settings.samples = 1000;
  settings.paths = measure::PathClasses::of("PSE");
  core::LocalRun run(1, 2);
  const auto comparison = compare_integrators(scene, ceiling_of(scene), {"path", "light"}, settings, run.get());
  EXPECT_EQ(comparison.trials[0].refused, "finds none of these paths, PSE");
  EXPECT_EQ(comparison.trials[1].refused, "");
  EXPECT_TRUE(comparison.pairs.empty());
}

// The point's own picture is nothing, so that nobody misses it.
TEST(IntegratorComparison, misses_no_pictures_of_points) {
  const scene::Scene scene = point_over_a_mirror();
  IntegratorSettings settings;
  settings.samples = 1000;
  settings.paths = measure::PathClasses::of("PE|PDE");
  core::LocalRun run(1, 2);
  const std::vector<measure::Measurement> pixel{measure::PixelRadiance{{0}, 0, 0}};
  const auto comparison = compare_integrators(scene, pixel, {"path", "light"}, settings, run.get());
  for (const IntegratorTrial& trial : comparison.trials) EXPECT_EQ(trial.missed, "") << trial.integrator;
}

TEST(IntegratorComparison, has_an_efficiency_that_counts_noise_and_bias) {
  SceneBuilder builder({"grey"});
  const scene::Scene scene = builder.finish();
  const auto known = [](double value, double standard_error, double bound) {
    Estimate e = unbiased_estimate(test::grey(value), test::grey(standard_error), 100);
    e.error_bound = test::grey(bound);
    return e;
  };
  IntegratorTrial trial{"some", "", "", measure::PathClasses::all(), {}, 2};
  EXPECT_EQ(trial.efficiency(scene), 0);  // knows nothing
  trial.found = {known(10, 1, 0), known(20, 2, 0), known(0, 0, 0)};
  EXPECT_NEAR(trial.efficiency(scene), 1 / (.01 * 2), 1e-9);
  trial.found[0] = known(10, .6, .8);  // .36 + .64 = 1
  EXPECT_NEAR(trial.efficiency(scene), 1 / (.01 * 2), 1e-9);
  const RelativeErrors errors = trial.relative_errors(scene);  // .06 and .1 of noise, .08 and 0 of bounds
  EXPECT_NEAR(errors.noise, std::sqrt((.0036 + .01) / 2), 1e-12);
  EXPECT_NEAR(errors.bound, std::sqrt(.0064 / 2), 1e-12);
  EXPECT_EQ(errors.over, 2u);        // not of what is dark
  trial.found[1] = known(20, 6, 0);  // (.01 + .09) / 2
  EXPECT_NEAR(trial.efficiency(scene), 1 / (.05 * 2), 1e-9);
}

TEST(IntegratorComparison, has_nothing_where_it_is_stopped_at_once) {
  const scene::Scene scene = point_over_a_mirror();
  std::stop_source source;
  source.request_stop();
  core::LocalRun run(1, 2);
  run.get().stop = source.get_token();
  EXPECT_THROW(compare_integrators(scene, ceiling_of(scene), {"path", "light"}, {}, run.get()), core::Interrupted);
}

}  // namespace
}  // namespace interflect::montecarlo

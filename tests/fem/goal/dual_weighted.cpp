#include "fem/goal/dual_weighted.h"

#include <gtest/gtest.h>

#include "tests/fem/goal/random_rooms.h"

namespace interflect::fem {
namespace {

// J(B_h) = <z_h, e>, whatever the mesh and the goal.
TEST(DualWeighted, finds_the_goal_by_importance_alone) {
  std::mt19937 random(5);
  for (const int order : {1, 2})
    for (int k = 0; k < 3; ++k) {
      const scene::Scene scene = test::random_box(random);
      const auto rays = raycast::make_ray_caster("embree", scene);
      core::LocalRun run(1, 2);
      RadiositySettings settings = test::settings_of(order, 1e-3);
      settings.element_size = 1.1;
      const test::Solved s = test::solved(scene, settings, run.get());
      for (const Goal& goal : test::goals_in(scene)) {
        const DualWeighted found = test::dual_weighted_of(s, scene, goal, settings, *rays, run.get());
        EXPECT_GT(found.value[0], 0);
        EXPECT_NEAR(found.by_importance[0], found.value[0], 1e-12 * found.value[0]) << goal.name;
        Spectrum sum;
        for (const Spectrum& eta : found.of_elements) sum += eta;
        EXPECT_NEAR(sum[0], found.correction[0], 1e-12 * found.value[0]);
      }
    }
}

// Held against order 2 on smaller elements: estimate over error is between 0.5 and 3 in nine of ten.
TEST(DualWeighted, is_as_large_as_the_error) {
  std::mt19937 random(11);
  core::LocalRun run(1, 2);
  int count = 0, fine = 0;
  for (int k = 0; k < 6; ++k) {
    const scene::Scene scene = test::random_box(random);
    const auto rays = raycast::make_ray_caster("embree", scene);
    RadiositySettings of_coarse = test::settings_of(1), of_truth = test::settings_of(2);
    of_coarse.element_size = .9;
    of_truth.element_size = .45;
    const test::Solved coarse = test::solved(scene, of_coarse, run.get()),
                       truth = test::solved(scene, of_truth, run.get());
    for (const Goal& goal : test::goals_in(scene)) {
      const DualWeighted found = test::dual_weighted_of(coarse, scene, goal, of_coarse, *rays, run.get());
      const double error =
          test::dual_weighted_of(truth, scene, goal, of_truth, *rays, run.get()).value[0] - found.value[0];
      const double effectivity = found.correction[0] / error;
      ++count;
      fine += effectivity > .5 && effectivity < 3;
    }
  }
  EXPECT_GE(fine, 0.9 * count);
}

}  // namespace
}  // namespace interflect::fem

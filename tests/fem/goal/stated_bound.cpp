#include <gtest/gtest.h>

#include "tests/fem/goal/stated_bounds.h"

namespace interflect::fem {
namespace {

// In a room, pass after pass; many rooms: many_goals.cpp.
TEST(StatedBound, of_each_pass_holds_and_is_not_far_above_the_error) {
  std::mt19937 random(31);
  core::LocalRun run(1, 2);
  const scene::Scene scene = test::random_box(random);
  const test::KnownGoals known(scene, .45, 1e-4, run.get());
  test::Effectivity found;
  for (const Goal& goal : test::goals_in(scene))
    for (const test::Stated& pass : known.stated(goal, 2, 0, 2e-4)) found.add(pass);
  EXPECT_GE(found.size(), 4u);
  EXPECT_EQ(found.beyond(), 0);
  EXPECT_GT(found.least(), 1.5);
  EXPECT_LT(found.quantile(.5), 4);
}

}  // namespace
}  // namespace interflect::fem

#include <gtest/gtest.h>

#include <array>
#include <cstdio>

#include "tests/fem/goal/stated_bounds.h"

namespace interflect::fem {
namespace {

std::vector<Goal> three_goals(const scene::Scene& scene) {
  std::vector<Goal> goals = test::goals_in(scene);
  goals.push_back({"wall", Goal::OnSurface{scene::SurfaceId{3}, scene::Side::front}});
  return goals;
}

void report(const char* what, const test::Effectivity& found) {
  std::printf("%s: %zu passes, %d beyond; bound over error: least %.2f, 10 %% %.2f, median %.2f, 90 %% %.2f\n", what,
              found.size(), found.beyond(), found.least(), found.quantile(.1), found.quantile(.5), found.quantile(.9));
  std::fflush(stdout);
}

// Three goals in each of random rooms, elements of order 1 and up to order 2, from the start that is the default one:
// stated bounds hold, and most are two to four times the error.
TEST(StatedBound, holds_of_goals_in_many_rooms) {
  std::mt19937 random(31);
  core::LocalRun run;
  test::Effectivity found;
  for (int k = 0; k < 12; ++k) {
    const scene::Scene scene = test::random_box(random);
    const test::KnownGoals known(scene, .45, 1e-5, run.get());
    for (const Goal& goal : three_goals(scene))
      for (const int order : {1, 2})
        for (const test::Stated& pass : known.stated(goal, order, 0, 1e-4)) found.add(pass);
  }
  report("as started by default", found);
  EXPECT_LE(found.beyond(), .02 * double(found.size()));
  EXPECT_LT(found.quantile(.5), 3);
  EXPECT_LT(found.quantile(.9), 10);
}

// From whole faces, twelve elements, which is what an element size larger than the room asks for: where no node sees a
// shadow nothing tells of it but what passes change.  A twentieth of them is off by more than stated, 2.7 times as much
// at worst.
TEST(StatedBound, from_whole_faces_holds_mostly) {
  std::mt19937 random(31);
  core::LocalRun run;
  test::Effectivity found, last;
  std::array<test::Effectivity, 2> of_order;
  for (int k = 0; k < 12; ++k) {
    const scene::Scene scene = test::random_box(random);
    const test::KnownGoals known(scene, .45, 1e-5, run.get());
    for (const Goal& goal : three_goals(scene))
      for (const int order : {1, 2}) {
        const std::vector<test::Stated> passes = known.stated(goal, order, 3, 1e-3);
        for (const test::Stated& pass : passes) {
          found.add(pass);
          of_order[std::size_t(order - 1)].add(pass);
        }
        last.add(passes.back());
      }
  }
  report("from whole faces", found);
  report("    of order 1", of_order[0]);
  report("    up to order 2", of_order[1]);
  report("    last passes", last);
  EXPECT_LE(found.beyond(), .1 * double(found.size()));
  EXPECT_LE(last.beyond(), .1 * double(last.size()));
  EXPECT_LT(found.quantile(.5), 3);
}

}  // namespace
}  // namespace interflect::fem

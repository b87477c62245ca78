#include "core/team.h"

#include <gtest/gtest.h>

using namespace interflect;

// Each work is done by every member once, and done when `work` returns, after a sleep too.
TEST(Team, has_every_member_do_a_work_once) {
  for (const unsigned members : {1u, 2u, 3u, 8u}) {
    core::Team team(members);
    ASSERT_EQ(team.size(), members);
    std::vector<int> done(members, 0);
    for (int work = 1; work <= 50; ++work) {
      team.work([&](unsigned member) { ++done[member]; });
      EXPECT_EQ(done, std::vector<int>(members, work));
      if (work % 25 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  }
}

// A sum goes round: each member adds to what the one before it has left, a thousand times.  With more members than
// processors it comes to an end too.
TEST(Team, has_members_that_wait_for_each_other) {
  for (const unsigned members : {2u, 3u, 8u}) {
    core::Team team(members);
    std::vector<core::StepCount> steps(members);
    const Index rounds = 1000;
    Index sum = 0;
    team.work([&](unsigned member) {
      const unsigned before = (member + members - 1) % members;
      for (Index round = 1; round <= rounds; ++round) {
        steps[before].wait_for(member == 0 ? round - 1 : round);
        ++sum;
        steps[member].raise_to(round);
      }
    });
    EXPECT_EQ(sum, rounds * members);
  }
}

TEST(StepCount, is_not_waited_for_where_it_is_reached) {
  core::StepCount steps;
  steps.wait_for(0);
  steps.raise_to(7);
  steps.wait_for(7);
  steps.wait_for(3);
}

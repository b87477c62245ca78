#include "solvers/tournament.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/random.h"

using namespace interflect;
using namespace interflect::solvers;

// Numbers from a few values, so that there are ties: the first of the largest, after every change.
TEST(Tournament, knows_the_first_of_the_largest_after_every_change) {
  for (const Index n : {1, 2, 3, 7, 8, 9, 100, 1025}) {
    core::RandomNumbers random(static_cast<std::uint64_t>(n), 0, 0);
    Tournament tournament(n);
    std::vector<double> values(static_cast<std::size_t>(n), 0.0);
    EXPECT_EQ(tournament.winner(), 0);
    for (int k = 0; k < 2000; ++k) {
      const auto player = static_cast<std::size_t>(random.next() * static_cast<double>(n));
      values[player] = std::floor(10 * random.next());
      tournament.set(static_cast<Index>(player), values[player]);
      const auto expected = std::max_element(values.begin(), values.end());
      ASSERT_EQ(tournament.winner(), expected - values.begin());
      ASSERT_EQ(tournament.largest(), *expected);
    }
  }
}

TEST(Tournament, lets_what_is_no_number_win_wherever_it_is) {
  for (Index at = 0; at < 5; ++at) {
    Tournament tournament(5);
    for (Index player = 0; player < 5; ++player) tournament.set(player, 3.0 + static_cast<double>(player));
    tournament.set(at, std::numeric_limits<double>::quiet_NaN());
    EXPECT_EQ(tournament.winner(), at);
    tournament.set(at, 0);
    EXPECT_EQ(tournament.winner(), at == 4 ? 3 : 4);
  }
}

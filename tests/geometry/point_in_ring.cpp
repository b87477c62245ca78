#include "geometry/point_in_ring.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace interflect::geometry {
namespace {

TEST(PointInRing, is_told_from_outside_whichever_way_the_ring_runs) {
  std::vector<Vec2> L{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}};
  for (int turn = 0; turn < 2; ++turn) {
    for (const Vec2& inside : {Vec2(0.5, 0.5), Vec2(2.9, 0.5), Vec2(0.5, 2.9)}) EXPECT_TRUE(encloses(L, inside));
    for (const Vec2& outside : {Vec2(2, 2), Vec2(-1, 1), Vec2(4, 0.5), Vec2(0.5, -1), Vec2(-1, 3), Vec2(-1, 0)})
      EXPECT_FALSE(encloses(L, outside)) << outside.transpose();
    std::reverse(L.begin(), L.end());
  }
}

// An outline joined to its hole by a bridge that is run along twice.
TEST(PointInRing, edges_that_are_run_along_twice_do_not_count) {
  const std::vector<Vec2> ring{{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 2}, {1, 2},
                               {1, 3}, {3, 3}, {3, 1}, {1, 1}, {1, 2}, {0, 2}};
  EXPECT_FALSE(encloses(ring, {2, 2}));
  for (const Vec2& p : {Vec2(0.5, 2.1), Vec2(0.5, 1.9), Vec2(3.5, 2), Vec2(2, 0.5)}) EXPECT_TRUE(encloses(ring, p));
}

// One unit in the last place beside an edge of slope 1/3, where the rounded product cannot tell.
TEST(PointInRing, is_exact_beside_an_edge) {
  const std::vector<Vec2> triangle{{0, 0}, {3, 1}, {0, 1}};
  for (const double x : {0.3, 0.7, 1.1, 2.3}) {
    const double y = x / 3;  // rounded: the exact height of the edge is within half a unit
    EXPECT_TRUE(encloses(triangle, {x, std::nextafter(y, 2)}));
    EXPECT_FALSE(encloses(triangle, {x, std::nextafter(y, -2)}));
  }
}

}  // namespace
}  // namespace interflect::geometry

#include "geometry/box_grid.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/random.h"

namespace interflect::geometry {
namespace {

// Whatever holds a point is near it, once, at any scale, flat or not, of unequal sizes; and not much
// else is where boxes are alike.
TEST(BoxGrid, finds_every_box_that_holds_a_point) {
  core::RandomNumbers random(3, 0, 0);
  const auto point = [&](double scale, bool flat) -> Vec3 {
    return scale * Vec3(random.next(), random.next(), flat ? .5 : random.next());
  };
  for (const double scale : {1e-6, 1.0, 1e6})
    for (const bool flat : {false, true})
      for (const int n : {1, 2, 50, 700}) {
        std::vector<Box> boxes;
        for (int k = 0; k < n; ++k) {
          const Vec3 low = point(scale, flat);
          boxes.emplace_back(low,
                             low + point(scale * (k % 50 == 0 ? .8 : .05), flat) - Vec3(0, 0, flat ? .4 * scale : 0));
          boxes.back() =
              Box(boxes.back().min().cwiseMin(boxes.back().max()), boxes.back().min().cwiseMax(boxes.back().max()));
        }
        const BoxGrid grid(boxes);
        for (int trial = 0; trial < 200; ++trial) {
          const Box& one = boxes[static_cast<std::size_t>(trial) % boxes.size()];
          const Vec3 x = trial % 3 == 0 ? one.max() : trial % 3 == 1 ? Vec3(one.center()) : point(scale, flat);
          std::vector<std::uint32_t> near(grid.near(x).begin(), grid.near(x).end());
          std::ranges::sort(near);
          EXPECT_EQ(std::ranges::adjacent_find(near), near.end());
          for (std::uint32_t k = 0; k < boxes.size(); ++k) {
            if (boxes[k].contains(x)) {
              EXPECT_TRUE(std::binary_search(near.begin(), near.end(), k));
            }
          }
        }
      }
}

TEST(BoxGrid, of_a_regular_plane_has_few_near_a_point) {
  std::vector<Box> boxes;
  for (int a = 0; a < 40; ++a)
    for (int b = 0; b < 30; ++b) boxes.emplace_back(Vec3(a, b, -1e-9), Vec3(a + 1, b + 1, 1e-9));
  const BoxGrid grid(boxes);
  core::RandomNumbers random(4, 0, 0);
  std::size_t all = 0;
  for (int trial = 0; trial < 1000; ++trial) all += grid.near({40 * random.next(), 30 * random.next(), 0}).size();
  EXPECT_LT(all, 4 * 1000u);
}

// Boxes of a plane that does not begin where cells do: the first one near a point mostly holds it.
TEST(BoxGrid, likely_boxes_come_first) {
  std::vector<Box> boxes;
  for (int a = 0; a < 40; ++a)
    for (int b = 0; b < 30; ++b) boxes.emplace_back(Vec3(a * a, b, 0), Vec3((a + 1) * (a + 1), b + 1, 0));
  const BoxGrid grid(boxes);
  core::RandomNumbers random(4, 0, 0);
  int first = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const Vec3 x(1600 * random.next(), 30 * random.next(), 0);
    first += boxes[grid.near(x)[0]].contains(x);
  }
  EXPECT_GT(first, 650);
}

TEST(BoxGrid, of_nothing_has_nothing) { EXPECT_TRUE(BoxGrid().near(Vec3::Zero()).empty()); }

}  // namespace
}  // namespace interflect::geometry

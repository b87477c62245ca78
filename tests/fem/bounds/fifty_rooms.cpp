#include <gtest/gtest.h>

#include <cstdio>

#include "tests/fem/bounds/random_room.h"

namespace interflect::fem {
namespace {

// Fifty random rooms: the bounds never fail, are at most five times as wide as B - B_h is large, and narrow with the
// elements at least as fast.
TEST(EnclosureOfFiftyRooms, never_fails) {
  constexpr double enough_memory = 12e9, doubt_of_truth = 3e-4, coarse = .7, fine = .35;
  core::LocalRun run;
  double of_coarse = 0, of_fine = 0, coarse_elements = 0, fine_elements = 0, widest_coarse = 0, widest_fine = 0;
  int points = 0;
  for (unsigned seed = 101; seed <= 150; ++seed) {
    std::mt19937 random(seed);
    const scene::Scene scene = test::random_room(random);
    const test::NearlyTrue truth(scene, .45, run.get());
    for (const double size : {coarse, fine}) {
      const RadiositySolution s = test::solved(scene, size, 0, run.get());
      const Enclosure enclosure(scene, s, enough_memory, run.get());
      const test::Held held = test::held_against(enclosure, s, truth, doubt_of_truth, size == coarse ? 1 : 3);
      EXPECT_EQ(held.outside, 0) << seed << ", " << size;
      EXPECT_LT(held.width, 5 * held.largest_error) << seed << ", " << size;
      points += held.points;
      double& widest = size == coarse ? widest_coarse : widest_fine;
      widest = std::max(widest, held.width / held.largest_error);
      (size == coarse ? of_coarse : of_fine) += held.all_width;
      (size == coarse ? coarse_elements : fine_elements) += static_cast<double>(s.mesh.size());
      std::printf("room %u, %td elements: width %.4f, largest error %.4f, ratio %.2f\n", seed, s.mesh.size(),
                  held.width, held.largest_error, held.width / held.largest_error);
      std::fflush(stdout);
    }
  }
  const double order = std::log(of_coarse / of_fine) / std::log(std::sqrt(fine_elements / coarse_elements));
  std::printf("%d points, none outside; widest of the coarse %.2f, of the fine %.2f; order %.2f\n", points,
              widest_coarse, widest_fine, order);
  EXPECT_GE(order, 1);
}

}  // namespace
}  // namespace interflect::fem

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/fem/bounds/manufactured.h"
#include "tests/fem/bounds/random_room.h"

namespace interflect::fem {
namespace {

constexpr double enough_memory = 12e9;

// Fifty random rooms: the bounds never fail, near corners, in the middle and anywhere else in elements, and are at most
// five times as wide as B - B_h is large.
TEST(EnclosureOfFiftyRooms, never_fails) {
  constexpr double doubt_of_truth = 3e-4, coarse = .7, fine = .35;
  core::LocalRun run;
  double widest_coarse = 0, widest_fine = 0;
  int points = 0;
  for (unsigned seed = 101; seed <= 150; ++seed) {
    std::mt19937 random(seed);
    const scene::Scene scene = test::random_room(random);
    const test::NearlyTrue truth(scene, .45, run.get());
    for (const double size : {coarse, fine}) {
      const RadiositySolution s = test::solved(scene, size, 0, run.get());
      const Enclosure enclosure(scene, s, enough_memory, run.get());
      const test::Held held =
          test::held_against(enclosure, s, truth, doubt_of_truth, size == coarse ? 1 : 3, size == coarse ? 4 : 6, seed);
      EXPECT_EQ(held.outside, 0) << seed << ", " << size;
      EXPECT_LT(held.width, 5 * held.largest_error) << seed << ", " << size;
      points += held.points;
      double& widest = size == coarse ? widest_coarse : widest_fine;
      widest = std::max(widest, held.width / held.largest_error);
      std::printf("room %u, %td elements: width %.4f, largest error %.4f, ratio %.2f\n", seed, s.mesh.size(),
                  held.width, held.largest_error, held.width / held.largest_error);
      std::fflush(stdout);
    }
  }
  std::printf("%d points, none outside; widest of the coarse %.2f, of the fine %.2f\n", points, widest_coarse,
              widest_fine);
}

struct Width {
  double elements, of_radiosity;
};
Width width(const scene::Scene& scene, double element_size, Run& run) {
  const RadiositySolution s = test::solved(scene, element_size, 0, run);
  const Enclosure enclosure(scene, s, enough_memory, run);
  double sum = 0, area = 0;
  for (std::size_t i = 0; i < s.mesh.patches().size(); ++i) {
    const Interval& B = enclosure.radiosity()[i];
    sum += s.mesh.patches()[i].area * (B.upper[0] - B.lower[0]);
    area += s.mesh.patches()[i].area;
  }
  return {static_cast<double>(s.mesh.size()), sum / area};
}

/// In h = 1 / sqrt(number of elements).
double order_of(const Width& coarse, const Width& fine) {
  return 2 * std::log(coarse.of_radiosity / fine.of_radiosity) / std::log(fine.elements / coarse.elements);
}

/// Room by room, from one element size to another.
void expect_order(unsigned first, unsigned last, double of_coarse, double of_fine, bool few) {
  core::LocalRun run;
  double least = 10, most = 0;
  for (unsigned seed = first; seed <= last; ++seed) {
    std::mt19937 random(seed);
    const scene::Scene scene = test::random_room(random);
    const Width coarse = width(scene, of_coarse, run.get()), fine = width(scene, of_fine, run.get());
    EXPECT_TRUE(few ? fine.elements <= 160 : coarse.elements > 160) << seed;
    const double order = order_of(coarse, fine);
    EXPECT_GE(order, 1) << seed;
    least = std::min(least, order);
    most = std::max(most, order);
    std::printf("room %u: %g to %g elements, width %.4f to %.4f, order %.2f\n", seed, coarse.elements, fine.elements,
                coarse.of_radiosity, fine.of_radiosity, order);
    std::fflush(stdout);
  }
  std::printf("orders %.2f to %.2f\n", least, most);
}

// In every single room, where elements are looked at in as many parts before and after: up to 160 of them are cut four
// times over, more of them three times.
TEST(EnclosureOfFiftyRooms, narrows_with_the_elements) { expect_order(101, 150, 1.4, .7, true); }
TEST(EnclosureOfFiftyRooms, narrows_with_many_elements) { expect_order(101, 106, .34, .25, false); }

TEST(Enclosure, holds_manufactured_solutions_in_twenty_rooms) {
  core::LocalRun run;
  for (const int order : {0, 1})
    for (unsigned seed = 21; seed <= 40; ++seed) {
      const test::Manufactured found = test::manufactured(seed, order, enough_memory, run.get());
      EXPECT_EQ(found.outside, 0) << seed << ", order " << order << ", of " << found.elements;
    }
}

}  // namespace
}  // namespace interflect::fem

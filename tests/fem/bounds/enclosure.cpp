#include "fem/bounds/enclosure.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "tests/fem/bounds/manufactured.h"
#include "tests/fem/bounds/random_room.h"

namespace interflect::fem {
namespace {

using test::NearlyTrue;
using test::Room;

constexpr double enough_memory = 8e9, doubt_of_truth = 5e-4;

// Random rooms with a body: the bounds hold everywhere, and are not five times as wide as B - B_h is large.
TEST(Enclosure, holds_the_truth_and_not_much_more) {
  core::LocalRun run(1, 2);
  for (const int seed : {2}) {  // fifty of them: fifty_rooms.cpp
    std::mt19937 random(static_cast<unsigned>(seed));
    const scene::Scene scene = test::random_room(random);
    const NearlyTrue truth(scene, .6, run.get());
    const RadiositySolution s = test::solved(scene, .45, 0, run.get());
    const Enclosure enclosure(scene, s, enough_memory, run.get());
    const test::Held held = test::held_against(enclosure, s, truth, doubt_of_truth, 5, 6, unsigned(seed));
    EXPECT_EQ(held.outside, 0) << seed << " of " << held.points;
    EXPECT_LT(held.width, 5 * held.largest_error) << seed;
    for (std::size_t i = 0; i < s.irradiance.size(); ++i) {  // Galerkin's means are nearer to the truth than constants
      EXPECT_GT(s.irradiance[i][0], enclosure.mean_irradiance()[i].lower[0]);
      EXPECT_LT(s.irradiance[i][0], enclosure.mean_irradiance()[i].upper[0]);
    }
    const Vec3 size = scene.box().sizes();
    for (const Vec3& share : {Vec3(.5, .15, .1), Vec3(.6, .9, .5), Vec3(.45, .5, .95)}) {
      const measure::PointIrradiance at{share.cwiseProduct(size), Vec3(.1, .2, 1).normalized(), {}};
      const Interval H = enclosure.irradiance_at(at);
      const double known = truth.irradiance(at);
      EXPECT_GT(known, H.lower[0] - doubt_of_truth);
      EXPECT_LT(known, H.upper[0] + doubt_of_truth);
      EXPECT_LT(H.upper[0] - H.lower[0], .5 * known);
    }
  }
}

// Where all that shines and all that reflects is the same, B_h is the truth, and its bounds are it.
TEST(Enclosure, of_a_furnace_is_the_solution) {
  for (const double scale : {1e-6, 1.0, 1e6}) {
    Room room;
    room.box(Vec3(0, 0, 0), Vec3(2, 1, 1) * scale, 1, true, .7, .3);
    room.box(Vec3(.4, .3, .2) * scale, Vec3(.5, .4, .3) * scale, 1, false, .7, .3);
    const scene::Scene scene = room.finish();
    core::LocalRun run(1, 2);
    RadiositySolution s = test::solved(scene, .7 * scale, 0, run.get());
    for (Spectrum& B : s.radiosity) B = Spectrum(1.0);
    const Enclosure enclosure(scene, s, enough_memory, run.get());
    for (const Interval& B : enclosure.radiosity()) {
      EXPECT_NEAR(B.lower[0], 1, 1e-9);
      EXPECT_NEAR(B.upper[0], 1, 1e-9);
    }
  }
}

// A manufactured solution B = b_f with the exitance that makes it one, about B_h = b_f + d: since all is linear this is
// the solution 0 without any exitance about d, whatever b_f is.  In random rooms the bounds hold 0 on every
// element, of B, of B - B_h at its corners and of the mean of H; and in these two they are narrower than d.
// They hold in twenty: fifty_rooms.cpp.
TEST(Enclosure, holds_a_manufactured_solution_about_anything) {
  core::LocalRun run(1, 2);
  for (const int order : {0, 1}) {
    double size = 0, width = 0;
    for (unsigned seed = 21; seed <= 22; ++seed) {
      const test::Manufactured found = test::manufactured(seed, order, enough_memory, run.get());
      EXPECT_EQ(found.outside, 0) << seed << ", order " << order << ", of " << found.elements;
      size += found.size;
      width += found.width;
    }
    EXPECT_LT(width, size) << order << ": " << width / size;
  }
}

// About linear functions they hold too, and narrow faster.
TEST(Enclosure, about_linear_functions_is_narrower) {
  core::LocalRun run(1, 2);
  std::mt19937 random(105);
  const scene::Scene scene = test::random_room(random);
  const NearlyTrue truth(scene, .45, run.get());
  double width[2];
  for (const int order : {0, 1}) {
    const RadiositySolution s = test::solved(scene, .35, order, run.get());
    const Enclosure enclosure(scene, s, enough_memory, run.get());
    width[order] = 0;
    for (std::size_t i = 0; i < s.radiosity.size(); ++i) {
      const scene::SurfacePatch& patch = s.mesh.patches()[i];
      const Interval& e = enclosure.error()[i];
      width[order] += patch.area * (e.upper[0] - e.lower[0]);
      for (std::size_t k = 0; k < patch.corners; ++k) {
        const Vec3 x = patch.centroid() + .98 * (patch.corner[k] - patch.centroid());
        const double B = s.exitance[i][0] + s.reflectance[i][0] * truth.irradiance({x, patch.normal(), patch.surface});
        const double B_h = s.field ? s.field->at(i, x)[0] : s.radiosity[i][0];
        EXPECT_GT(B - B_h, e.lower[0] - doubt_of_truth);
        EXPECT_LT(B - B_h, e.upper[0] + doubt_of_truth);
      }
    }
    const Vec3 size = scene.box().sizes();
    const measure::PointIrradiance at{Vec3(.5, .15, .1).cwiseProduct(size), Vec3(.1, .2, 1).normalized(), {}};
    EXPECT_GT(truth.irradiance(at), enclosure.irradiance_at(at).lower[0] - doubt_of_truth);
    EXPECT_LT(truth.irradiance(at), enclosure.irradiance_at(at).upper[0] + doubt_of_truth);
  }
  EXPECT_LT(width[1], .85 * width[0]);
}

// Bounds scale with lengths and with light as the solution does, and do not depend on the number of threads.
TEST(Enclosure, is_the_same_at_any_scale_and_for_any_threads) {
  std::vector<double> lower, upper;
  for (const auto& [scale, threads] :
       {std::pair(1.0, 2u), std::pair(1.0, 1u), std::pair(1e-6, 2u), std::pair(1e6, 1u)}) {
    std::mt19937 random(3);
    const scene::Scene scene = test::random_room(random, scale);
    core::LocalRun run(1, threads);
    const RadiositySolution s = test::solved(scene, 1.2 * scale, 0, run.get());
    const Enclosure enclosure(scene, s, enough_memory, run.get());
    ASSERT_TRUE(lower.empty() || lower.size() == enclosure.radiosity().size());
    const bool first = lower.empty();
    for (std::size_t i = 0; i < enclosure.radiosity().size(); ++i) {
      const Interval& B = enclosure.radiosity()[i];
      if (first) {
        lower.push_back(B.lower[0]);
        upper.push_back(B.upper[0]);
      } else if (scale == 1) {
        EXPECT_EQ(B.lower[0], lower[i]);
        EXPECT_EQ(B.upper[0], upper[i]);
      } else {
        EXPECT_NEAR(B.lower[0], lower[i], .05 * (upper[i] - lower[i]));
        EXPECT_NEAR(B.upper[0], upper[i], .05 * (upper[i] - lower[i]));
      }
    }
  }
}

// Without a ceiling nothing is known of what does not arrive, and the bounds still hold.
TEST(Enclosure, holds_in_an_open_scene) {
  Room room;
  room.wall({0, 0, 0}, {2, 0, 0}, {0, 1, 0}, 1, .6);
  room.wall({0, 0, 0}, {0, 1, 0}, {0, 0, 1}, 1, .5, 1);
  room.wall({2, 0, 0}, {0, 0, 1}, {0, 1, 0}, 1, .7);
  room.box({.8, .3, .1}, {.4, .3, .3}, 1, false, .4);
  const scene::Scene scene = room.finish();
  core::LocalRun run(1, 2);
  const NearlyTrue truth(scene, .5, run.get());
  const RadiositySolution s = test::solved(scene, .3, 0, run.get());
  EXPECT_FALSE(s.closed);
  const Enclosure enclosure(scene, s, enough_memory, run.get());
  const test::Held held = test::held_against(enclosure, s, truth, doubt_of_truth, 2, 6);
  EXPECT_EQ(held.outside, 0) << held.points;
}

// The panel stands on the floor's diagonal, so that quarters of the floor touch its horizon with a corner.  In a turned
// scene rounding puts some of those above it: a part that has no area is no reason to know nothing.
TEST(Enclosure, holds_where_parts_touch_a_horizon) {
  core::LocalRun run(1, 2);
  for (const double turn : {0.0, .7}) {
    const Eigen::AngleAxisd by(turn, Vec3(.48, .6, .64));
    const Vec3 x = by * Vec3(1, 0, 0), y = by * Vec3(0, .8, 0), up = by * Vec3(0, 0, .3);
    Room room;
    room.wall({0, 0, 0}, x, y, 1, .6, 1);
    room.wall(.1 * (x + y), .8 * (x + y), up, 1, .5);
    room.wall(.1 * (x + y), up, .8 * (x + y), 1, .7);
    const scene::Scene scene = room.finish();
    const NearlyTrue truth(scene, .25, run.get());
    for (const int order : {0, 1}) {
      const RadiositySolution s = test::solved(scene, 2, order, run.get());
      const Enclosure enclosure(scene, s, enough_memory, run.get());
      const test::Held held = test::held_against(enclosure, s, truth, doubt_of_truth, 1, 6);
      EXPECT_EQ(held.outside, 0) << held.points << ", order " << order << ", turned by " << turn;
      for (const auto& bounds : {enclosure.irradiance(), enclosure.mean_irradiance(), enclosure.error()})
        for (const Interval& of : bounds)
          EXPECT_TRUE(std::isfinite(of.lower[0]) && std::isfinite(of.upper[0])) << order << ", turned by " << turn;
    }
  }
}

TEST(Enclosure, says_what_it_cannot) {
  Room room;
  room.box(Vec3(0, 0, 0), Vec3(1, 1, 1), 1, true, .5, .5);
  room.box(Vec3(.3, .3, .3), Vec3(.2, .2, .2), 1, false, 1);
  const scene::Scene mirror = room.finish();
  core::LocalRun run(1, 2);
  RadiositySolution s = test::solved(mirror, .6, 0, run.get());
  EXPECT_THROW(Enclosure(mirror, s, enough_memory, run.get()), core::InputError);
  std::mt19937 random(1);
  const scene::Scene scene = test::random_room(random);
  const RadiositySolution of_room = test::solved(scene, .6, 0, run.get());
  EXPECT_THROW(Enclosure(scene, of_room, 1e5, run.get()), core::InputError);
}

}  // namespace
}  // namespace interflect::fem

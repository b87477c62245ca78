#include "fem/bounds/black_backs.h"

#include <gtest/gtest.h>

#include <numeric>
#include <utility>

#include "fem/bounds/lit_regions.h"
#include "tests/fem/bounds/random_room.h"

namespace interflect::fem {
namespace {

using scene::Side;
using test::NearlyTrue;
using test::Room;

constexpr double enough_memory = 8e9;

double area_of(std::span<const scene::SurfacePatch> patches) {
  return std::accumulate(patches.begin(), patches.end(), 0.0,
                         [](double sum, const scene::SurfacePatch& patch) { return sum + patch.area; });
}

std::vector<scene::SurfacePatch> backs_of(const scene::Scene& scene) {
  const auto cells = scene_cells(scene);
  return BlackBacks(scene, cells.value()).all().value();
}

bool holds(std::span<const Vec3> ring, const Vec3& normal, const Vec3& x) {
  constexpr double in_plane = 1e-9;
  return std::abs(normal.dot(x - ring[0])) <= in_plane && depth_in(ring, normal, x) > 0;
}

/// At random points of all facets, on either side, what light that arrives there ends on: how often it is nothing, and
/// how often more than one of backs, or a back beside an element.
struct Ends {
  int points = 0, none = 0, many = 0;
};
Ends ends_in(const scene::Scene& scene, std::mt19937& random) {
  const std::vector<scene::SurfacePatch> backs = backs_of(scene);
  std::uniform_real_distribution<double> part(0, 1);
  Ends ends;
  for (const scene::Facet& facet : scene.facets)
    for (int k = 0; k < 40; ++k) {
      const double root = std::sqrt(part(random)), v = root * part(random);
      const Vec3 x = (1 - root) * facet.corner[0] + (root - v) * facet.corner[1] + v * facet.corner[2];
      for (const Vec3& way : {facet.normal, Vec3(-facet.normal)}) {
        const auto faces = [&](const Vec3& normal) { return normal.dot(way) > .99; };
        const bool on_element = std::any_of(scene.facets.begin(), scene.facets.end(), [&](const scene::Facet& other) {
          const Side side = faces(other.normal) ? Side::front : Side::back;
          return std::abs(other.normal.dot(way)) > .99 && scene.material(other.surface).active(side) &&
                 holds(other.corner, other.normal, x);
        });
        const auto on_backs = std::count_if(backs.begin(), backs.end(), [&](const scene::SurfacePatch& back) {
          return faces(back.normal()) && holds(back.ring(), back.normal(), x);
        });
        ++ends.points;
        ends.none += !on_element && on_backs == 0;
        ends.many += on_backs > (on_element ? 0 : 1);
      }
    }
  return ends;
}

// One wall of two rooms, of which one is lower: behind it the higher one's back is bare.
TEST(BlackBacks, are_left_out_where_the_front_of_another_wall_is) {
  Room room;
  room.wall({0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 1);   // fronts -x
  room.wall({0, 0, 0}, {0, 1, 0}, {0, 0, .6}, 1);  // fronts +x
  EXPECT_NEAR(area_of(backs_of(room.finish())), 1 - .6, 1e-9);
  Room apart;
  apart.wall({0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 1);
  apart.wall({1e-6, 0, 0}, {0, 1, 0}, {0, 0, .6}, 1);
  EXPECT_NEAR(area_of(backs_of(apart.finish())), 1.6, 1e-9);
}

// Walls in one plane, of any outline and facing either way, with a partition on one of them that halves, where its
// plane goes on, what another wall covers.
TEST(BlackBacks, and_elements_are_all_that_light_ends_on_and_nothing_twice) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> part(0, 1);
  for (int k = 0; k < 40; ++k) {
    Room room;
    const auto place = [&](double u, double v, double w) { return Vec3(.8 * u - .6 * w, v, .6 * u + .8 * w); };
    room.wall(place(0, 0, 0), place(2, 0, 0), place(0, 1, 0), 1);
    room.wall(place(.1, .5, 0), place(.5, 0, 0), place(0, 0, .4), 1);
    room.wall(place(1, .25, 0), place(0, .5, 0), place(.5, 0, 0), 1);
    for (int n = 0; n < 4; ++n)
      room.triangle(place(2 * part(random), part(random), 0), place(2 * part(random), part(random), 0),
                    place(2 * part(random), part(random), 0));
    const Ends ends = ends_in(room.finish(), random);
    EXPECT_EQ(ends.none, 0) << k << " of " << ends.points;
    EXPECT_EQ(ends.many, 0) << k << " of " << ends.points;
  }
}

/// Two rooms, each a floor, a wall that shines and one that the other room's stands behind; without ceilings.
/// @param gap  between these two walls; below 0 the rooms overlap
scene::Scene open_rooms(double gap) {
  Room room;
  const Vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  room.wall({0, 0, 0}, x, y, 1, .6, .3);
  room.wall({0, 0, 0}, y, z, 1, .5, 1);
  room.wall({1, 0, 0}, z, y, 1, .7);
  const Vec3 beyond(1 + gap, 0, 0);
  room.wall(beyond, .5 * x, y, 1, .5, .2);
  room.wall(beyond, y, .5 * z, 1, .6);
  room.wall(beyond + .5 * x, z, y, 1, .4, .8);
  return room.finish();
}

test::Held held_of(const scene::Scene& scene) {
  core::LocalRun run(1, 2);
  constexpr double doubt_of_truth = 2e-3;
  const NearlyTrue truth(scene, .51, run.get());
  const RadiositySolution s = test::solved(scene, .51, 0, run.get());
  return test::held_against(Enclosure(scene, s, enough_memory, run.get()), s, truth, doubt_of_truth, 1);
}

// Counted beside the wall in whose place it lies, a back made bounds of more than half of the points wrong, since
// sum_P F_P was more than 1.
TEST(BlackBacks, in_the_place_of_elements_leave_bounds_that_hold) {
  const test::Held held = held_of(open_rooms(0));
  EXPECT_EQ(held.outside, 0) << held.points;
  EXPECT_LT(held.width, 4 * held.largest_error);
}

// A back that stands 1e-10 before a wall hides it, and has to be there: in a closed scene bounds were wrong without it.
TEST(BlackBacks, are_there_where_they_are_apart_from_elements) {
  for (const auto& [gap, area] : {std::pair(-1e-10, 2.0), std::pair(0.0, 0.0), std::pair(1e-10, 2.0)}) {
    Room room;
    room.box({0, 0, 0}, {1, 1, 1}, 1);
    room.box({1 + gap, 0, 0}, {.7, 1, 1}, 1);
    const LitRegions lit(room.finish());
    EXPECT_TRUE(lit.closed());
    EXPECT_NEAR(area_of(lit.black_sides()), area, 1e-9) << gap;
  }
}

// Where it is not known whether one hides the other, bounds do without backs.
TEST(BlackBacks, that_may_be_in_front_or_not_leave_bounds_that_hold) {
  constexpr double gap = -3e-11;
  Room room;
  room.box({0, 0, 0}, {1, 1, 1}, 1);
  room.box({1 + gap, 0, 0}, {.7, 1, 1}, 1);
  EXPECT_FALSE(LitRegions(room.finish()).closed());
  const scene::Scene scene = open_rooms(gap);
  EXPECT_FALSE(BlackBacks(scene, scene_cells(scene).value()).all());
  const test::Held held = held_of(scene);
  EXPECT_EQ(held.outside, 0) << held.points;
}

}  // namespace
}  // namespace interflect::fem

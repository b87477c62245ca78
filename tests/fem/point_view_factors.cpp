#include "fem/point_view_factors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "core/random.h"
#include "fem/form_factor/point_to_polygon.h"
#include "tests/fem/direct_light.h"
#include "tests/fem/rooms.h"

namespace interflect::fem {
namespace {

using test::Room;

struct Seen {
  std::vector<double> F, error;
  double total() const { return std::accumulate(F.begin(), F.end(), 0.0); }
  double total_error() const { return std::accumulate(error.begin(), error.end(), 0.0); }
};
Seen seen_from(const PointViewFactors& factors, const measure::PointIrradiance& at) {
  Seen seen{std::vector<double>(static_cast<std::size_t>(factors.elements())), {}};
  seen.error = seen.F;
  factors(at, seen.F, seen.error);
  return seen;
}
measure::PointIrradiance point(const Vec3& x, const Vec3& n = Vec3::UnitZ()) { return {x, n, std::nullopt}; }

// Whole and in 3 x 3 elements, at three scales: to the 12 digits of the table, within errors that say as much.
TEST(PointViewFactors, under_a_blocker_are_the_exact_penumbra) {
  for (const double scale : {1e-6, 1.0, 1e6})
    for (const int n : {1, 3}) {
      Room room;
      room.wall(scale * Vec3(-.5, -.5, 2), scale * Vec3(0, 1, 0), scale * Vec3(1, 0, 0), n);
      room.screen(scale * Vec3(-.5, -.5, 1), scale * Vec3(1, 0, 0), scale * Vec3(0, 1, 0));
      const auto scene = room.finish();
      const PointViewFactors factors(scene, room.patches);
      for (const test::DirectLight& row : test::direct_light) {
        const Seen seen = seen_from(factors, point(scale * row.x));
        EXPECT_NEAR(seen.total(), row.blocked, 1e-12) << row.x.transpose() << " at scale " << scale;
        EXPECT_LT(seen.total_error(), 2e-14);
      }
    }
}

// F(S) - F(S in P1) - F(S in P2) + F(S in P1 and P2), P the projections of two blockers that overlap from the point:
// rectangles all.
TEST(PointViewFactors, behind_two_blockers_that_overlap_count_what_both_hide_once) {
  Room room;
  room.wall({-.5, -.5, 2}, {0, 1, 0}, {1, 0, 0}, 2);
  room.screen({-.4, -.6, 1}, {.5, 0, 0}, {0, .9, 0});
  room.screen({-.2, -.1, .5}, {.35, 0, 0}, {0, .5, 0});
  const auto scene = room.finish();
  const PointViewFactors factors(scene, room.patches);
  const auto through = [](const Vec3& x, double height, double low_x, double low_y, double high_x, double high_y) {
    const double k = 2 / height;  // from x onto z = 2
    return Eigen::AlignedBox2d(Vec2(x.x() + k * (low_x - x.x()), x.y() + k * (low_y - x.y())),
                               Vec2(x.x() + k * (high_x - x.x()), x.y() + k * (high_y - x.y())));
  };
  const Eigen::AlignedBox2d source(Vec2(-.5, -.5), Vec2(.5, .5));
  const auto factor = [](const Vec3& x, const Eigen::AlignedBox2d& b) {
    if (b.isEmpty()) return 0.0;
    const std::array<Vec3, 4> ring{Vec3(b.min().x(), b.min().y(), 2), Vec3(b.max().x(), b.min().y(), 2),
                                   Vec3(b.max().x(), b.max().y(), 2), Vec3(b.min().x(), b.max().y(), 2)};
    return point_to_polygon(x, Vec3::UnitZ(), ring);
  };
  core::RandomNumbers random(3, 0, 0);
  int overlaps = 0;
  for (int k = 0; k < 200; ++k) {
    const Vec3 x(2 * random.next() - 1, 2 * random.next() - 1, 0);
    const auto one = source.intersection(through(x, 1, -.4, -.6, .1, .3)),
               two = source.intersection(through(x, .5, -.2, -.1, .15, .4));
    const double both = factor(x, one.intersection(two)),
                 exact = factor(x, source) - factor(x, one) - factor(x, two) + both;
    const Seen seen = seen_from(factors, point(x));
    EXPECT_NEAR(seen.total(), exact, seen.total_error() + 1e-15);
    EXPECT_LT(seen.total_error(), 1e-13);
    overlaps += both > 1e-3;
  }
  EXPECT_GT(overlaps, 20);
}

/// A room of 3 x 2 x 2 with a box and a plate that is seen from both sides, all in elements.
Room furnished(double scale, int n, const Vec3& shift = Vec3::Zero()) {
  const auto at = [&](double x, double y, double z) -> Vec3 { return scale * Vec3(x, y, z) + shift; };
  const auto side = [&](double x, double y, double z) -> Vec3 { return scale * Vec3(x, y, z); };
  Room room;
  room.box(at(0, 0, 0), side(3, 2, 2), n);
  room.box(at(.4, .5, 0), side(.7, .6, .9), n, false);
  room.wall(at(1.7, .3, .3), side(.2, 1, 0), side(0, .3, 1.2), n);
  room.wall(at(1.7, .3, .3), side(0, .3, 1.2), side(.2, 1, 0), n);
  return room;
}
bool is_free(const Vec3& x) { return !(x.x() > .4 && x.x() < 1.1 && x.y() > .5 && x.y() < 1.1 && x.z() < .9); }

// What hides is seen in its place: the sum stays 1, wherever the point is, whichever way it looks.
TEST(PointViewFactors, of_a_closed_room_sum_to_one) {
  for (const double scale : {1e-6, 1.0, 1e6}) {
    Room room = furnished(scale, 3);
    const auto scene = room.finish();
    const PointViewFactors factors(scene, room.patches);
    core::RandomNumbers random(5, 0, 0);
    for (int k = 0; k < 100; ++k) {
      const Vec3 x(3 * random.next(), 2 * random.next(), 2 * random.next());
      const Vec3 n = (Vec3(random.next(), random.next(), random.next()) - Vec3::Constant(.5)).normalized();
      if (!is_free(x)) continue;
      const Seen seen = seen_from(factors, point(scale * x, n));
      EXPECT_NEAR(seen.total(), 1, seen.total_error()) << x.transpose() << " towards " << n.transpose();
      EXPECT_LT(seen.total_error(), 1e-10);
      for (const double F : seen.F) EXPECT_TRUE(F >= 0 && F <= 1);
    }
    for (const Vec3& x : {Vec3(1.5, .2, 0), Vec3(1e-3, 1.99, 0), Vec3(1e-6, 1e-6, 0), Vec3(.3999, .7, 0)}) {
      const Seen seen = seen_from(factors, {scale * x, Vec3::UnitZ(), scene::SurfaceId{4}});
      EXPECT_NEAR(seen.total(), 1, 1e-10) << x.transpose();
      EXPECT_NEAR(seen.total(), 1, seen.total_error()) << x.transpose();
    }
  }
}

// A surface in more elements: the same from each point, up to the stated errors of both, which are those of rounding.
TEST(PointViewFactors, are_additive_within_their_errors) {
  for (const Vec3& shift : {Vec3(0, 0, 0), Vec3(1e3 / 3, -2e3 / 7, 1e2 / 9), Vec3(1e7 / 3, 2e7 / 7, 1e6 / 9)}) {
    Room one = furnished(1, 1, shift), many = furnished(1, 4, shift);
    const auto scene_of_one = one.finish(), scene_of_many = many.finish();
    const PointViewFactors whole(scene_of_one, one.patches), parts(scene_of_many, many.patches);
    core::RandomNumbers random(7, 0, 0);
    double largest = 0;
    for (int k = 0; k < 100; ++k) {
      const Vec3 x(3 * random.next(), 2 * random.next(), 2 * random.next());
      const Vec3 n = (Vec3(random.next(), random.next(), random.next()) - Vec3::Constant(.5)).normalized();
      if (!is_free(x)) continue;
      const Seen a = seen_from(whole, point(x + shift, n)), b = seen_from(parts, point(x + shift, n));
      for (std::size_t surface = 0; surface < one.patches.size(); ++surface) {
        double sum = 0, error = a.error[surface];
        for (std::size_t j = 16 * surface; j < 16 * surface + 16; ++j) sum += b.F[j], error += b.error[j];
        EXPECT_NEAR(a.F[surface], sum, error);
        largest = std::max(largest, error);
      }
    }
    EXPECT_LT(largest, 1e-11 * std::max(1.0, shift.norm()));
  }
}

// On an edge of the room nobody can tell whether the wall beside the point is in front of it: half of the hemisphere.
TEST(PointViewFactors, of_a_point_in_a_walls_plane_say_that_they_cannot_know) {
  Room room;
  room.box({0, 0, 0}, {2, 2, 2}, 1);
  const auto scene = room.finish();
  const PointViewFactors factors(scene, room.patches);
  const Seen seen = seen_from(factors, {Vec3(0, 1, 0), Vec3::UnitZ(), scene::SurfaceId{4}});
  EXPECT_EQ(seen.F[0], 0);
  EXPECT_NEAR(seen.error[0], 1 - seen.total(), 1e-9);
  EXPECT_EQ(seen.error[4], 0) << "the floor, on which it lies, it does not see";
}

}  // namespace
}  // namespace interflect::fem

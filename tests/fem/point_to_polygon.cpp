#include "fem/form_factor/point_to_polygon.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/error.h"
#include "core/random.h"
#include "tests/fem/direct_light.h"

namespace interflect::fem {
namespace {

using Ring = std::vector<Vec3>;

// A rectangle with a corner above x, sides a and b, parallel to dA at distance h:
// F = 1/(2 pi) [X/sqrt(1+X²) atan(Y/sqrt(1+X²)) + Y/sqrt(1+Y²) atan(X/sqrt(1+Y²))], X = a/h, Y = b/h.
double corner_rectangle(double X, double Y) {
  const double p = std::sqrt(1 + X * X), q = std::sqrt(1 + Y * Y);
  return 0.5 * inv_pi * (X / p * std::atan(Y / p) + Y / q * std::atan(X / q));
}

TEST(PointToPolygon, agrees_with_the_closed_form_of_a_rectangle_above_its_corner) {
  for (double a : {0.1, 1.0, 7.0})
    for (double b : {0.2, 3.0})
      for (double h : {0.05, 1.0, 20.0}) {
        const Ring ring = {{0, 0, h}, {0, b, h}, {a, b, h}, {a, 0, h}};
        EXPECT_NEAR(point_to_polygon(Vec3::Zero(), Vec3::UnitZ(), ring) / corner_rectangle(a / h, b / h), 1.0, 1e-12);
      }
}

// docs/truths.md 2.9: a square of half side .5 two metres above, from points beside its axis.
TEST(PointToPolygon, agrees_with_the_table_of_direct_light) {
  const Ring ring = {{-.5, -.5, 2}, {-.5, .5, 2}, {.5, .5, 2}, {.5, -.5, 2}};
  for (const test::DirectLight& light : test::direct_light)
    EXPECT_NEAR(point_to_polygon(light.x, Vec3::UnitZ(), ring), light.open, 1e-12);
}

TEST(PointToPolygon, is_additive_over_a_partition_across_the_horizon) {
  core::RandomNumbers random(3, 0, 0);
  for (int trial = 0; trial < 200; ++trial) {
    const auto point = [&](double size) -> Vec3 {
      return size * Vec3(random.next() - .5, random.next() - .5, random.next() - .5);
    };
    const Vec3 a = point(4), b = point(4), c = point(4), x = point(1), n = point(1).normalized(),
               middle = (a + b + c) / 3;
    const double whole = point_to_polygon(x, n, Ring{a, b, c});
    const double parts = point_to_polygon(x, n, Ring{a, b, middle}) + point_to_polygon(x, n, Ring{b, c, middle}) +
                         point_to_polygon(x, n, Ring{c, a, middle});
    EXPECT_NEAR(whole, parts, 1e-13);
    EXPECT_NEAR(whole, point_to_polygon(x, n, Ring{c, b, a}), 1e-15) << "either orientation";
  }
}

TEST(PointToPolygon, of_a_closed_box_around_the_point_is_one) {
  const Vec3 x(.3, -.2, .45), n = Vec3(1, 2, -3).normalized();
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis)
    for (double side : {-1.0, 1.0}) {
      Ring ring(4);
      const double u[] = {-1, 1, 1, -1}, v[] = {-1, -1, 1, 1};
      for (std::size_t k = 0; k < 4; ++k)
        ring[k][axis] = side, ring[k][(axis + 1) % 3] = u[k], ring[k][(axis + 2) % 3] = v[k];
      sum += point_to_polygon(x, n, ring);
    }
  EXPECT_NEAR(sum, 1.0, 1e-14);
}

TEST(PointToPolygon, is_zero_behind_the_horizon_and_in_the_plane) {
  EXPECT_EQ(point_to_polygon(Vec3::Zero(), Vec3::UnitZ(), Ring{{0, 0, -1}, {1, 0, -1}, {0, 1, -1}}), 0.0);
  EXPECT_EQ(point_to_polygon(Vec3::Zero(), Vec3::UnitZ(), Ring{{1, 0, 0}, {2, 0, 0}, {1, 1, 0}}), 0.0);
  EXPECT_THROW(point_to_polygon(Vec3::Zero(), Vec3::UnitZ(), Ring(9, Vec3(0, 0, 1))), core::PreconditionError);
}

// Far away the formula loses digits in proportion to the distance, and the one-node rule gains them with its square.
TEST(PointToPolygon, is_accurate_far_away_by_both_rules) {
  for (double distance : {50.0, 100.0, 1e3, 1e5}) {
    const double h = distance;
    const Ring ring = {{0, 0, h}, {0, 1, h}, {1, 1, h}, {1, 0, h}};
    const double X = 1 / h, p = std::sqrt(1 + X * X), exact = inv_pi * X / p * std::atan(X / p);
    EXPECT_NEAR(point_to_polygon(Vec3::Zero(), Vec3::UnitZ(), ring) / exact, 1.0, 1e-15 * distance);
    const double far = point_to_polygon_far(Vec3::Zero(), Vec3::UnitZ(), Vec3(.5, .5, h), -Vec3::UnitZ(), 1.0);
    EXPECT_NEAR(far / exact, 1.0, 4.0 / (h * h) + 1e-14);
  }
}

}  // namespace
}  // namespace interflect::fem

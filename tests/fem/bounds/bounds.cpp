#include "fem/bounds/bounds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "fem/bounds/linear_field.h"
#include "tests/fem/bounds/random_room.h"

namespace interflect::fem {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Bounds between(double lower, double upper) {
  return {Eigen::RowVectorXd::Constant(1, lower), Eigen::RowVectorXd::Constant(1, upper)};
}

// What is not known may not get lost among what is: it would look as if less were to be held.
TEST(Bounds, are_of_nothing_known_where_a_part_is_not) {
  const Bounds unknown = between(std::nan(""), std::nan(""));
  for (const bool first : {true, false}) {
    Bounds all = Bounds::none(1);
    if (first) all.widen(unknown);
    all.widen(between(-1, 2));
    if (!first) all.widen(unknown);
    all.widen(between(-3, 1));
    ManyBounds many(1, 1);
    many.narrow(0, all);
    EXPECT_EQ(many.of(0).lower[0], -infinity);
    EXPECT_EQ(many.of(0).upper[0], infinity);
    many.narrow(0, between(0, 5));
    many.narrow(0, unknown);
    many.narrow(0, between(-1, 4));
    EXPECT_EQ(many.of(0).lower[0], 0);
    EXPECT_EQ(many.of(0).upper[0], 4);
  }
}

// Of a triangle the mean is that of its corners; of a side and of a point, without area, between what it is there.
TEST(LinearField, is_known_on_parts_without_area) {
  test::Room room;
  room.wall({0, 0, 0}, {2, 0, 0}, {0, 1, 0}, 1, .5);
  room.wall({0, 0, 0}, {0, 1, 0}, {0, 0, 1}, 1, .5, 1);
  const scene::Scene scene = room.finish();
  core::LocalRun run(1, 1);
  const RadiositySolution s = test::solved(scene, 3, 1, run.get());
  const Surroundings around(scene, s.mesh.patches(), true);
  const LinearField B(around, s, 1);
  const Cell floor = around.cell(s.mesh.patches()[0].ring());
  const Vec3 a = floor.ring[0], b = floor.ring[1], c = floor.ring[2];
  const double at_a = B.at(0, a, 0), at_b = B.at(0, b, 0), at_c = B.at(0, c, 0);
  ASSERT_GT(std::abs(at_a - at_b), .01);
  const Vec3 triangle[] = {a, b, c}, side[] = {a, b, a}, point[] = {b, b, b};
  EXPECT_NEAR(B.on(0, triangle, 0).mean, (at_a + at_b + at_c) / 3, 1e-12);
  const LinearField::OnPart on_side = B.on(0, side, 0), on_point = B.on(0, point, 0);
  EXPECT_EQ(on_side.mean, .5 * (at_a + at_b));
  EXPECT_EQ(on_side.deviation, .5 * std::abs(at_a - at_b));
  EXPECT_EQ(on_point.mean, at_b);
  EXPECT_EQ(on_point.lower, at_b);
  EXPECT_EQ(on_point.upper, at_b);
  EXPECT_EQ(on_point.deviation, 0);
}

}  // namespace
}  // namespace interflect::fem

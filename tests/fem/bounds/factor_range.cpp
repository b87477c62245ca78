#include "fem/bounds/factor_range.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "fem/form_factor/point_to_polygon.h"
#include "scene/place.h"
#include "tests/fem/random_pairs.h"

namespace interflect::fem {
namespace {

using geometry::Ring;

/// A cell and a polygon wholly in front of each other.
struct Sight {
  Ring cell, polygon;
  geometry::Plane plane;  ///< of the polygon, towards the cell
};
Sight random_sight(test::RandomPairs& random, double scale, const Vec3& offset) {
  while (true) {
    Ring cell = random.ring(.1 + .4 * random.next()), polygon = random.ring(.2 + random.next());
    const Vec3 way = (.3 + 1.5 * random.next()) * random.direction();
    for (Vec3& x : polygon) x += way;
    const Vec3 up = test::normal_of(cell), down = test::normal_of(polygon);
    bool faces = true;
    for (const Vec3& y : polygon) faces = faces && up.dot(y - cell[0]) > 0;
    for (const Vec3& x : cell) faces = faces && down.dot(x - polygon[0]) > 0;
    if (!faces) continue;
    for (Ring* ring : {&cell, &polygon})
      for (Vec3& x : *ring) x = scale * x + offset;
    return {cell, polygon, geometry::plane_of(polygon)};
  }
}

Vec3 random_point(test::RandomPairs& random, const Ring& ring) {
  Vec3 sum = Vec3::Zero();
  double all = 0;
  for (const Vec3& x : ring) {
    const double weight = -std::log(1e-300 + random.next());
    sum += weight * x;
    all += weight;
  }
  return sum / all;
}

double modelled(const FactorRange& range, const Vec2& d) {
  const auto& [s, t, ss, st, tt] = range.derivatives;
  return range.value + s * d.x() + t * d.y() + .5 * (ss * d.x() * d.x() + 2 * st * d.x() * d.y() + tt * d.y() * d.y());
}

// Nowhere in the cell is F outside of its bounds, corners among others; and of most pairs more is known than those.
TEST(FactorRange, holds_everywhere_in_the_cell) {
  for (const auto& [scale, offset] : {std::pair(1.0, Vec3(0, 0, 0)), std::pair(1e-6, Vec3(0, 0, 0)),
                                      std::pair(1e6, Vec3(0, 0, 0)), std::pair(1.0, Vec3(900, -400, 700))}) {
    test::RandomPairs random(7);
    int smooth = 0;
    constexpr int pairs = 2000;
    double largest = 0;
    for (int k = 0; k < pairs; ++k) {
      const Sight sight = random_sight(random, scale, offset);
      const Cell cell = cell_of(sight.cell);
      const FactorRange range = factor_range(cell, sight.polygon, sight.plane);
      smooth += range.smooth;
      const double rounding = 1e-12;  // of Lambert's formula, larger far from the origin
      const auto check = [&](const Vec3& x) {
        const double F = point_to_polygon(x, cell.normal, sight.polygon);
        EXPECT_LE(F, range.most + rounding);
        EXPECT_GE(F, range.least - rounding);
        if (!range.smooth) return;
        const double off = std::abs(F - modelled(range, cell.local(x)));
        EXPECT_LE(off, range.remainder + rounding);
        largest = std::max(largest, off / range.remainder);
      };
      for (const Vec3& x : sight.cell) check(x);
      for (int n = 0; n < 8; ++n) check(random_point(random, sight.cell));
    }
    EXPECT_GT(smooth, pairs / 4);
    EXPECT_GT(largest, .1);  // bounds that are ten times too wide would be of no use
  }
}

// The remainder is of third order.
TEST(FactorRange, narrows_by_eight_as_cells_are_halved) {
  const Ring polygon{{.3, .2, 1}, {.3, .7, 1.1}, {.8, .7, 1.1}, {.8, .2, 1}};
  const geometry::Plane plane = geometry::plane_of(polygon);
  double before = 0;
  for (const double size : {.2, .1, .05, .025}) {
    const Ring ring{{0, 0, 0}, {size, 0, 0}, {size, size, 0}, {0, size, 0}};
    const FactorRange range = factor_range(cell_of(ring), polygon, plane);
    ASSERT_TRUE(range.smooth);
    if (before > 0) {
      EXPECT_NEAR(std::log2(before / range.remainder), 3, .35);
    }
    before = range.remainder;
  }
}

// int k e is F times the mean of e, to within `across`: of e that is 1 and -1 on quarters, against their own factors.
TEST(FactorRange, tells_what_a_field_that_is_not_constant_may_send) {
  test::RandomPairs random(11);
  double largest = 0;
  for (int k = 0; k < 2000; ++k) {
    const Sight sight = random_sight(random, 1, Vec3::Zero());
    const Cell cell = cell_of(sight.cell);
    const FactorRange range = factor_range(cell, sight.polygon, sight.plane);
    if (!range.smooth) continue;
    const auto quarters = scene::quarters_of(sight.polygon);
    double mean = 0, area = 0;
    std::array<double, 4> e{}, areas{};
    for (std::size_t q = 0; q < 4; ++q) {
      e[q] = random.next() < .5 ? -1 : 1;
      areas[q] = test::area_of(Ring(quarters[q].begin(), quarters[q].begin() + std::ssize(sight.polygon)));
      mean += areas[q] * e[q];
      area += areas[q];
    }
    mean /= area;
    double deviation = 0;
    for (std::size_t q = 0; q < 4; ++q) deviation += areas[q] / area * std::abs(e[q] - mean);
    const Vec3 x = random_point(random, sight.cell);
    double sent = 0;
    for (std::size_t q = 0; q < 4; ++q)
      sent += e[q] * point_to_polygon(x, cell.normal, std::span(quarters[q]).first(sight.polygon.size()));
    const double off = std::abs(sent - point_to_polygon(x, cell.normal, sight.polygon) * mean);
    EXPECT_LE(off, range.across * deviation + 1e-13);
    if (deviation > 0) largest = std::max(largest, off / (range.across * deviation));
  }
  EXPECT_GT(largest, .1);
}

TEST(FactorRange, of_a_polygon_that_touches_the_cell_is_less_than_a_half_space) {
  const Ring cell{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, wall{{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}};
  const FactorRange range = factor_range(cell_of(cell), wall, geometry::plane_of(wall));
  EXPECT_FALSE(range.smooth);
  EXPECT_DOUBLE_EQ(range.most, .5);
  EXPECT_EQ(range.least, 0);
}

}  // namespace
}  // namespace interflect::fem

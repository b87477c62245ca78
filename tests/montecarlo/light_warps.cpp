#include <gtest/gtest.h>

#include "montecarlo/light/rectangle.h"
#include "montecarlo/warp/cone.h"
#include "montecarlo/warp/spherical_rectangle.h"
#include "montecarlo/warp/spherical_triangle.h"
#include "montecarlo/warp/table.h"
#include "tests/montecarlo/light_numbers.h"
#include "tests/montecarlo/statistics.h"

// What lights are drawn by: solid angles of rectangles, triangles and cones, and cells of maps.
namespace interflect::montecarlo {
namespace {

using test::grey;
using test::numbers_of;

constexpr double almost_one = 1 - 0x1p-53;

TEST(Warps, of_solid_angles_go_there_and_back) {
  const SphericalRectangle rectangle(Vec3::Zero(), Vec3(-.3, .2, .7), Vec3::UnitX(), Vec3::UnitY(), 1.2, 1.3);
  const SphericalTriangle triangle(
      {Vec3(.5, -.2, 1).normalized(), Vec3(1.2, .4, .8).normalized(), Vec3(-.1, .9, .6).normalized()});
  std::vector<double> weights{0, 1, 5, 0, 2, 0, 0, 0, 0, 0, 3, 0};
  const CellTable table(3, 4, weights);
  for (std::uint64_t k = 0; k < 20'000; ++k) {
    const auto r = numbers_of(70, k);
    const Vec2 u(r[0], r[1]);
    EXPECT_NEAR((rectangle.inverse(rectangle.point(u[0], u[1])) - u).norm(), 0, 1e-12);
    EXPECT_NEAR((triangle.inverse(triangle.direction(u[0], u[1])) - u).norm(), 0, 1e-12);
    for (const double cone : {1.0814e-5, .1, 1., 2.})
      EXPECT_NEAR((uniform_cone_inverse(cone, uniform_cone(cone, u[0], u[1])) - u).norm(), 0, 1e-11) << cone;
    EXPECT_NEAR((table.inverse(table.pick(u[0], u[1])) - u).norm(), 0, 1e-12);
    const auto cell = table.pick(u[0], u[1]);
    EXPECT_GT(table.probability(cell.row.cell, cell.column.cell), 0);
  }
  for (const double u : {0., almost_one})
    for (const double v : {0., almost_one}) {
      EXPECT_TRUE(rectangle.point(u, v).allFinite());
      EXPECT_TRUE(triangle.direction(u, v).allFinite());
      const auto cell = table.pick(u, v);
      EXPECT_GT(table.probability(cell.row.cell, cell.column.cell), 0);
    }
}

// Solid angles and form factors that are known (docs/truths.md; by independent code).
TEST(Warps, of_solid_angles_have_known_ones) {
  const SphericalRectangle rectangle(Vec3::Zero(), Vec3(-.3, .2, .7), Vec3::UnitX(), Vec3::UnitY(), 1.2, 1.3);
  EXPECT_NEAR(rectangle.solid_angle(), .835046076395, 1e-12);
  const SphericalTriangle triangle(
      {Vec3(.5, -.2, 1).normalized(), Vec3(1.2, .4, .8).normalized(), Vec3(-.1, .9, .6).normalized()});
  EXPECT_NEAR(triangle.solid_angle(), .439890018163, 1e-12);
  EXPECT_NEAR(SphericalTriangle({Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()}).solid_angle(), pi / 2, 1e-14);
  const double s = std::sqrt(.5);
  EXPECT_NEAR(SphericalTriangle({Vec3::UnitZ(), Vec3(s, 0, s), Vec3(0, s, s)}).solid_angle(), .3398369094541219, 1e-14);
  double of_rectangle = 0, of_triangle = 0;
  constexpr int n = 800;
  for (int a = 0; a < n; ++a)
    for (int b = 0; b < n; ++b) {
      const double u = (a + .5) / n, v = (b + .5) / n;
      const Vec2 y = rectangle.point(u, v);
      of_rectangle += .7 / Vec3(-.3 + y.x(), .2 + y.y(), .7).norm();
      of_triangle += triangle.direction(u, v).z();
    }
  EXPECT_NEAR(of_rectangle * rectangle.solid_angle() / pi / n / n, .18844500, 1e-7);
  EXPECT_NEAR(of_triangle * triangle.solid_angle() / pi / n / n, .10692718, 3e-7);  // sqrt(v) at a corner
}

/// Relative variance of one sample of the irradiance, by midpoints of its two numbers.
template <class Sample>
double relative_variance(const Sample& sample) {
  constexpr int n = 1000;
  double sum = 0, squares = 0;
  for (int a = 0; a < n; ++a)
    for (int b = 0; b < n; ++b) {
      const double f = sample((a + .5) / n, (b + .5) / n);
      sum += f, squares += f * f;
    }
  return squares * n * n / (sum * sum) - 1;
}

// A sampler by solid angle that has the first column is one by area.
TEST(RectangleLight, has_the_variance_of_what_it_says_it_draws_by) {
  const struct {
    double h, area, solid_angle;
  } known[] = {{.05, 42.1385, .232815}, {.1, 10.3151, .163391},  {.25, 1.445459, .059803},
               {.5, .255292, .014488},  {1, .0303545, .0018731}, {2, .0024842, .00015510}};
  for (const auto& [h, area, solid_angle] : known) {
    const RectangleLight light(Vec3(-.5, -.5, h), Vec3::UnitX(), Vec3::UnitY(), -Vec3::UnitZ(), grey(1));
    const Place at{Vec3::Zero(), Vec3::UnitZ()};
    const double found = relative_variance([&](double u, double v) {
      const auto s = light.sample_arriving(at, u, v);
      return s->way.z() / s->pdf_solid_angle;
    });
    const double expected = h < std::sqrt(.5) ? solid_angle : area;  // half its diameter
    EXPECT_NEAR(found, expected, 1e-3 * expected) << h;
    const SphericalRectangle seen(Vec3::Zero(), Vec3(-.5, -.5, h), Vec3::UnitX(), Vec3::UnitY(), 1, 1);
    const double by_solid_angle = relative_variance([&](double u, double v) {
      const Vec2 y = seen.point(u, v);
      return h / Vec3(y.x() - .5, y.y() - .5, h).norm();
    });
    EXPECT_NEAR(by_solid_angle, solid_angle, 1e-3 * solid_angle) << h;
  }
}

}  // namespace
}  // namespace interflect::montecarlo

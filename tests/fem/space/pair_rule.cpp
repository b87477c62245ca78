#include "fem/pair_rule.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "fem/kernel.h"

namespace interflect::fem {
namespace {

double exchange(const Panel& a, const Panel& b, const PairRule& rule) {
  const FlatlandKernel kernel;
  double sum = 0;
  rule.for_nodes(a, b, [&](const PairNode& node) {
    sum += node.weight * a.measure * b.measure *
           kernel(point_on(a.ring(), node.u_a, 0), a.normal, point_on(b.ring(), node.u_b, 0), b.normal);
  });
  return sum;
}

/// Two segments from the origin, `angle` apart, which see each other, and what crossed strings say: (a + b - c) / 2.
struct Corner {
  Panel a, b;
  double strings;
};
Corner corner(double length_a, double length_b, double angle) {
  const Vec3 end_a(length_a, 0, 0), end_b(length_b * std::cos(angle), length_b * std::sin(angle), 0);
  return {segment_panel(Vec3::Zero(), end_a), segment_panel(end_b, Vec3::Zero()),
          .5 * (length_a + length_b - (end_a - end_b).norm())};
}

// Exponentially, the slower the sharper the angle.
TEST(SegmentPairRule, of_touching_segments_converges_to_crossed_strings_at_any_angle_and_scale) {
  for (const double scale : {1e-6, 1.0, 1e6})
    for (const double angle : {.5, pi / 2, 2.5}) {
      const Corner at = corner(scale, .5 * scale, angle);
      EXPECT_NEAR(exchange(at.a, at.b, SegmentPairRule(40)) / at.strings, 1, 1e-12) << angle;
      EXPECT_NEAR(exchange(at.b, at.a, SegmentPairRule(40)) / at.strings, 1, 1e-12) << angle;
    }
}

// A product of Gauss rules errs by a part that does not fall beyond the first power of their number.
TEST(SegmentPairRule, does_what_products_cannot) {
  const Corner at = corner(1, 1, pi / 2);
  EXPECT_GT(std::abs(exchange(at.a, at.b, ProductPairRule(12)) / at.strings - 1), 1e-3);
  EXPECT_LT(std::abs(exchange(at.a, at.b, SegmentPairRule(12)) / at.strings - 1), 1e-10);
}

TEST(SegmentPairRule, of_segments_apart_converges_to_crossed_strings) {
  const Panel a = segment_panel({0, 0, 0}, {1, 0, 0}), b = segment_panel({1, .5, 0}, {0, .5, 0});
  const double strings = std::hypot(1, .5) - .5;
  EXPECT_GT(std::abs(exchange(a, b, SegmentPairRule(3)) - strings), 1e-6);
  EXPECT_NEAR(exchange(a, b, SegmentPairRule(24)), strings, 1e-13);
}

TEST(PairRule, of_other_panels_is_refused) {
  Panel triangle = segment_panel({0, 0, 0}, {1, 0, 0});
  triangle.corners = 3;
  EXPECT_THROW(ProductPairRule(2).for_nodes(triangle, triangle, [](const PairNode&) {}), core::PreconditionError);
}

// In flatland nothing depends on z.
TEST(FlatlandKernel, is_the_other_one_integrated_along_lines) {
  const Vec3 x(.3, 0, 0), normal_x(.6, .8, 0), y(.9, 1.1, 0), normal_y(-.6, -.8, 0);
  double sum = 0;  // z = tan(s), |s| < pi/2
  for (const RuleNode& node : gauss_legendre(60)) {
    const double s = pi * (node.u - .5), dz = pi / std::pow(std::cos(s), 2);
    sum += node.weight * dz * SpaceKernel()(x, normal_x, y + Vec3(0, 0, std::tan(s)), normal_y);
  }
  EXPECT_NEAR(FlatlandKernel()(x, normal_x, y, normal_y), sum, 1e-12);
  EXPECT_EQ(FlatlandKernel()(x, normal_x, y, -normal_y), 0);
  EXPECT_EQ(SpaceKernel()(x, -normal_x, y, normal_y), 0);
}

}  // namespace
}  // namespace interflect::fem

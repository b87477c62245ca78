#include "fem/quadrature.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "geometry/polygon.h"

namespace interflect::fem {
namespace {

double factorial(int n) { return std::tgamma(n + 1.0); }

// int u^p v^q over the reference triangle is p! q! / (p + q + 2)!; the rules' weights sum to 1 and not to 1/2.
TEST(Quadrature, triangle_rules_are_exact_for_all_monomials_of_their_degree) {
  for (int degree = 0; degree <= 8; ++degree) {
    const Rule rule = triangle_rule(degree);
    for (int p = 0; p <= degree; ++p)
      for (int q = 0; p + q <= degree; ++q) {
        double sum = 0;
        for (const RuleNode& node : rule) sum += node.weight * std::pow(node.u, p) * std::pow(node.v, q);
        EXPECT_NEAR(sum, 2 * factorial(p) * factorial(q) / factorial(p + q + 2), 1e-14)
            << degree << ": u^" << p << " v^" << q;
      }
  }
  EXPECT_THROW(triangle_rule(9), core::PreconditionError);
}

TEST(Quadrature, triangle_rules_have_positive_weights_and_nodes_inside) {
  for (int degree = 0; degree <= 8; ++degree)
    for (const RuleNode& node : triangle_rule(degree)) {
      EXPECT_GT(node.weight, 0);
      EXPECT_GT(std::min({node.u, node.v, 1 - node.u - node.v}), 0);
    }
}

TEST(Quadrature, gauss_rules_are_exact_up_to_degree_two_n_minus_one_and_not_beyond) {
  for (int n = 1; n <= 20; ++n) {
    const auto integral = [&](int power) {
      double sum = 0;
      for (const RuleNode& node : gauss_legendre(n)) sum += node.weight * std::pow(node.u, power);
      return sum;
    };
    for (int power = 0; power < 2 * n; ++power)
      EXPECT_NEAR(integral(power), 1.0 / (power + 1), 1e-14) << n << " points, u^" << power;
    if (n > 5) continue;  // beyond, the error of the next power drowns in rounding
    EXPECT_GT(std::abs(integral(2 * n) - 1.0 / (2 * n + 1)), 1e-8) << n;
  }
  EXPECT_THROW(gauss_legendre(0), core::PreconditionError);
}

// A trapezium: the bilinear map is not affine.  Its weights sum to the area, its first moments to area times centroid.
TEST(Quadrature, nodes_on_a_planar_quad_integrate_its_area_and_moments_exactly) {
  const std::vector<Vec3> ring = {{0, 0, 1}, {4, 0, 1}, {2, 1, 1}, {1, 1, 1}};
  for (int points = 1; points <= 4; ++points) {
    std::vector<SurfaceNode> nodes;
    append_nodes(ring, quad_rule(points), nodes);
    double area = 0;
    Vec3 moment = Vec3::Zero();
    for (const SurfaceNode& node : nodes) area += node.weight, moment += node.weight * node.position;
    EXPECT_NEAR(area, geometry::vector_area(ring).norm(), 1e-14);
    if (points > 1) {
      EXPECT_NEAR(moment.x(), 4.5, 1e-13);  // int_0^1 (right² - left²)/2 dy with right = 4 - 2y, left = y
      EXPECT_NEAR(moment.y(), 1.0, 1e-13);  // int_0^1 y (4 - 3y) dy
    }
  }
}

// u^p v^q over the triangle is p! q! / (p + q + 2)!, twice that of its mean; over the square 1 / ((p + 1) (q + 1)).
TEST(Quadrature, closed_rules_are_exact_to_degree_three_and_begin_in_the_middle) {
  const auto mean = [](const Rule& rule, int p, int q) {
    double sum = 0;
    for (const RuleNode& node : rule) sum += node.weight * std::pow(node.u, p) * std::pow(node.v, q);
    return sum;
  };
  const double factorial[] = {1, 1, 2, 6, 24, 120};
  for (int p = 0; p <= 3; ++p)
    for (int q = 0; p + q <= 3; ++q) {
      EXPECT_NEAR(mean(closed_triangle_rule(), p, q), 2 * factorial[p] * factorial[q] / factorial[p + q + 2], 1e-15);
      EXPECT_NEAR(mean(closed_quad_rule(), p, q), 1.0 / ((p + 1) * (q + 1)), 1e-15);
    }
  EXPECT_NEAR(closed_triangle_rule().front().u + closed_triangle_rule().front().v, 2.0 / 3, 1e-15);
  EXPECT_EQ(closed_quad_rule().front().u + closed_quad_rule().front().v, 1);
}

}  // namespace
}  // namespace interflect::fem

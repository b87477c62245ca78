#include "fem/space/element_basis.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "core/error.h"
#include "core/random.h"
#include "fem/quadrature.h"
#include "fem/space/plane_basis.h"
#include "scene/place.h"

namespace interflect::fem {
namespace {

using Ring = std::vector<Vec3>;

/// On a plane that is none of the axes'.
Vec3 on_plane(double x, double y) { return Vec3(1, -2, 3) + x * Vec3(.6, .8, 0) + y * Vec3(0, .6, -.8); }

struct Element {
  const char* name;
  Ring ring;
};
std::vector<Element> elements(double scale = 1) {
  std::vector<Element> all = {
      {"segment", {on_plane(0, 0), on_plane(2, 1)}},
      {"triangle", {on_plane(0, 0), on_plane(3, .2), on_plane(.5, 1)}},
      {"needle", {on_plane(0, 0), on_plane(100, 0), on_plane(99, .01)}},
      {"square", {on_plane(0, 0), on_plane(1, 0), on_plane(1, 1), on_plane(0, 1)}},
      {"parallelogram", {on_plane(0, 0), on_plane(3, 1), on_plane(4, 1.5), on_plane(1, .5)}},
      {"trapezoid", {on_plane(0, 0), on_plane(4, 0), on_plane(1.2, 1), on_plane(1, 1)}},
      {"bent quad", {on_plane(0, 0), on_plane(2, .3), on_plane(1.3, 1.4), on_plane(-.2, 1)}},
  };
  for (Element& element : all)
    for (Vec3& p : element.ring) p *= scale;
  return all;
}

/// Of the mean over an element: more than exact for any two functions.
std::vector<RuleNode> nodes_of(const Ring& ring) {
  std::vector<RuleNode> nodes;
  double sum = 0;
  for (const RuleNode& a : gauss_legendre(9))
    for (const RuleNode& b : ring.size() == 2 ? Rule{{0, 0, 1}} : gauss_legendre(9)) {
      const double u = ring.size() == 3 ? a.u * (1 - b.u) : a.u, squeezed = ring.size() == 3 ? 1 - b.u : 1;
      nodes.push_back({u, b.u, a.weight * b.weight * squeezed * jacobian(ring, u, b.u)});
      sum += nodes.back().weight;
    }
  for (RuleNode& node : nodes) node.weight /= sum;
  return nodes;
}

Eigen::VectorXd values(const ElementBasis& basis, double u, double v) {
  Eigen::VectorXd N(basis.size());
  basis.at(u, v, {N.data(), static_cast<std::size_t>(N.size())});
  return N;
}

TEST(ElementBasis, is_orthonormal_in_the_mean_on_every_element_at_every_scale) {
  for (const double scale : {1e-6, 1.0, 1e6})
    for (const Element& element : elements(scale))
      for (int order = 0; order <= ElementBasis::highest_order; ++order) {
        const ElementBasis basis(order, element.ring);
        Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(basis.size(), basis.size());
        for (const RuleNode& node : nodes_of(element.ring)) {
          const Eigen::VectorXd N = values(basis, node.u, node.v);
          EXPECT_NEAR(N[0], 1, 1e-13);
          gram += node.weight * N * N.transpose();
        }
        EXPECT_LT((gram - Eigen::MatrixXd::Identity(basis.size(), basis.size())).cwiseAbs().maxCoeff(), 1e-12)
            << element.name << " " << order << " " << scale;
      }
}

// Of the plane's own coordinates: also where the element's are bilinear.
TEST(ElementBasis, holds_every_polynomial_of_its_degree) {
  core::RandomNumbers random(3, 0, 0);
  for (const Element& element : elements())
    for (int order = 0; order <= ElementBasis::highest_order; ++order) {
      const ElementBasis basis(order, element.ring);
      const Vec3 along = element.ring[1] - element.ring[0], across = element.ring.back() - element.ring[0];
      const double a = random.next(), b = random.next(), c = random.next();
      const auto f = [&](double u, double v) {
        const Vec3 x = point_on(element.ring, u, v) - element.ring[0];
        return std::pow(a * x.dot(along) / along.squaredNorm() + b * x.dot(across) / across.squaredNorm() + c, order);
      };
      Eigen::VectorXd coefficients = Eigen::VectorXd::Zero(basis.size());
      for (const RuleNode& node : nodes_of(element.ring))
        coefficients += node.weight * f(node.u, node.v) * values(basis, node.u, node.v);
      for (const RuleNode& node : nodes_of(element.ring))
        EXPECT_NEAR(coefficients.dot(values(basis, node.u, node.v)), f(node.u, node.v), 1e-11)
            << element.name << " " << order;
    }
}

TEST(ElementBasis, begins_with_the_functions_of_lower_orders) {
  for (const Element& element : elements())
    for (int order = 1; order <= ElementBasis::highest_order; ++order) {
      const ElementBasis high(order, element.ring), low(order - 1, element.ring);
      const Eigen::VectorXd of_high = values(high, .3, .4), of_low = values(low, .3, .4);
      EXPECT_LT((of_high.head(low.size()) - of_low).cwiseAbs().maxCoeff(), 1e-12) << element.name << " " << order;
    }
}

// At points of the quarter, found again in the whole by their positions.
TEST(ElementBasis, is_that_of_its_quarters_restricted) {
  for (const Element& element : elements()) {
    if (element.ring.size() == 2) continue;
    for (int order = 0; order <= ElementBasis::highest_order; ++order)
      for (std::size_t quarter = 0; quarter < 4; ++quarter) {
        const Eigen::MatrixXd R = restriction(order, element.ring, quarter);
        const auto part = scene::quarters_of(element.ring)[quarter];
        const Ring ring(part.begin(), part.begin() + std::ssize(element.ring));
        const ElementBasis whole(order, element.ring), of_part(order, ring);
        for (const auto& [u, v] : {std::pair(.1, .2), std::pair(.5, .4), std::pair(.3, .6)}) {
          const Vec3 x = point_on(ring, u, v);
          // Newton's iteration on the bilinear map; exact at once on triangles.
          double s = .5, t = .5;
          for (int step = 0; step < 40; ++step) {
            const Vec3 miss = x - point_on(element.ring, s, t),
                       along = point_on(element.ring, s + .5, t) - point_on(element.ring, s - .5, t),
                       across = point_on(element.ring, s, t + .5) - point_on(element.ring, s, t - .5),
                       n = along.cross(across);
            s += miss.cross(across).dot(n) / n.squaredNorm();
            t += along.cross(miss).dot(n) / n.squaredNorm();
          }
          EXPECT_LT((values(whole, s, t) - R * values(of_part, u, v)).cwiseAbs().maxCoeff(), 1e-9)
              << element.name << " " << order << " " << quarter;
        }
      }
  }
}

// Means over halves and quarters: (1/2) sum R^T R and (1/4) sum R^T R where quarters have equal areas.
TEST(ElementBasis, keeps_lengths_when_it_is_restricted) {
  for (const Element& element : elements()) {
    const std::size_t parts = element.ring.size() == 2 ? 2 : 4;
    if (element.ring.size() == 4 && element.name != std::string("square") &&
        element.name != std::string("parallelogram"))
      continue;
    for (int order = 0; order <= ElementBasis::highest_order; ++order) {
      Eigen::MatrixXd sum = 0 * restriction(order, element.ring, 0);
      for (std::size_t part = 0; part < parts; ++part) {
        const Eigen::MatrixXd R = restriction(order, element.ring, part);
        sum += R * R.transpose() / static_cast<double>(parts);
      }
      EXPECT_LT((sum - Eigen::MatrixXd::Identity(sum.rows(), sum.cols())).cwiseAbs().maxCoeff(), 1e-12) << element.name;
    }
  }
}

TEST(ElementBasis, of_no_known_order_or_shape_is_refused) {
  const Ring pentagon(5, Vec3::Zero()), triangle{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  EXPECT_THROW(ElementBasis(1, pentagon), core::PreconditionError);
  EXPECT_THROW(ElementBasis(4, triangle), core::PreconditionError);
  EXPECT_THROW(ElementBasis(-1, triangle), core::PreconditionError);
}

// What |N_a| are at most is not below what they are anywhere, and not far above.
TEST(PlaneBasis, knows_the_most_that_its_functions_are) {
  core::RandomNumbers random(77, 0, 0);
  for (int trial = 0; trial < 60; ++trial) {
    const double width = std::pow(10.0, -3 * random.next());  // slender ones too
    const std::vector<Vec3> quad{Vec3(0, 0, 0), Vec3(1 + random.next(), 0, 0), Vec3(0.8 + random.next(), width, 0),
                                 Vec3(0.3 * random.next(), width * (0.4 + random.next()), 0)};
    for (const std::size_t corners : {std::size_t{3}, std::size_t{4}})
      for (const int order : {0, 1, 2, 3}) {
        const std::span<const Vec3> ring(quad.data(), corners);
        const PlaneBasis basis(order, ring, Vec3::UnitZ());
        double most = 0;
        for (int i = 0; i <= 40; ++i)
          for (int j = 0; j <= 40; ++j) {
            const double u = i / 40.0, v = corners == 3 ? (1 - u) * j / 40.0 : j / 40.0;
            most = std::max(most, basis.at(point_on(ring, u, v)).cwiseAbs().maxCoeff());
          }
        ASSERT_GE(basis.largest(), most * (1 - 1e-9)) << trial << " " << corners << " " << order;
        ASSERT_LE(basis.largest(), 200 * most) << trial << " " << corners << " " << order;
      }
  }
}

}  // namespace
}  // namespace interflect::fem

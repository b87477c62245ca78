#include <gtest/gtest.h>

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <vector>

#include "core/error.h"
#include "fem/collocation.h"
#include "solvers/solver.h"
#include "tests/fem/space/facing_strips.h"
#include "tests/fem/space/flatland.h"

namespace interflect::fem {
namespace {

using test::ExactStrips;
using test::facing_strips;
using test::strip_exitance;

/// Two strips of width 1, 0.5 apart, rho = 0.8 both, E = 1 on the first.
constexpr double rho = .8;

const ExactStrips& exact() {
  static const ExactStrips solution([](double) { return rho; });
  return solution;
}

constexpr int inner_points = 14;

/// What is told of a solution, as in the table: in L2 over the second strip, largest at nodes, largest of the iterated
/// one, and of the second strip's integral.
struct Errors {
  double L2, nodal, iterated, functional;
};

/// (f_h - f) and its square, integrated over the second strip.
void measure_second_strip(const Space& space, const Eigen::VectorXd& c, Errors& errors) {
  double square = 0, integral = 0;
  for (Index i = std::ssize(space.panels()) / 2; i < std::ssize(space.panels()); ++i) {
    const PanelNodes at = space.nodes(i, 8);
    const Eigen::VectorXd mine = at.values * c.segment(space.first(i), space.functions(i));
    for (std::size_t k = 0; k < at.weight.size(); ++k) {
      const double difference = mine[static_cast<Index>(k)] - exact()(at.position[k]);
      square += at.weight[k] * difference * difference;
      integral += at.weight[k] * difference;
    }
  }
  errors.L2 = std::sqrt(square);
  errors.functional = std::abs(integral);
}

Errors errors_of(const Space& space, const Eigen::VectorXd& c) {
  Errors errors{};
  measure_second_strip(space, c, errors);
  const FlatlandKernel kernel;
  std::vector<PanelNodes> sources;
  for (Index j = 0; j < std::ssize(space.panels()); ++j) sources.push_back(space.nodes(j, inner_points));
  for (Index i = 0; i < std::ssize(space.panels()); ++i) {
    const PanelNodes nodes = space.nodes(i, space.order() + 1), fine = space.nodes(i, 5);
    const auto own = c.segment(space.first(i), space.functions(i));
    for (std::size_t k = 0; k < nodes.weight.size(); ++k)
      errors.nodal = std::max(errors.nodal,
                              std::abs(nodes.values.row(static_cast<Index>(k)).dot(own) - exact()(nodes.position[k])));
    for (const Vec3& x : fine.position) {
      double B = strip_exitance(x);
      for (Index j = 0; j < std::ssize(space.panels()); ++j) {
        const PanelNodes& at = sources[static_cast<std::size_t>(j)];
        const Eigen::VectorXd b = at.values * c.segment(space.first(j), space.functions(j));
        for (std::size_t l = 0; l < at.weight.size(); ++l)
          B += rho * at.weight[l] * kernel(x, space.panel(i).normal, at.position[l], space.panel(j).normal) *
               b[static_cast<Index>(l)];
      }
      errors.iterated = std::max(errors.iterated, std::abs(B - exact()(x)));
    }
  }
  return errors;
}

Errors by_galerkin(int n, int order) {
  const Space space(facing_strips(n), order);
  return errors_of(space, test::solved_in_flatland(
                              space, rho, [](Index, const Vec3& x) { return strip_exitance(x); }, inner_points));
}

/// Values at the nodes.
Eigen::VectorXd solved(const NodeSet& nodes, const NodeOperator& T) {
  const Index unknowns = T.layout().unknowns();
  solvers::ColumnMatrix rows(unknowns, unknowns);
  T.rows(0, unknowns, rows);
  Eigen::VectorXd e(unknowns);
  for (Index a = 0; a < unknowns; ++a) e[a] = strip_exitance(nodes.position[static_cast<std::size_t>(a)]);
  const Eigen::MatrixXd A = Eigen::MatrixXd::Identity(unknowns, unknowns) - rho * rows;
  return A.partialPivLu().solve(e);
}

Errors by_collocation(int n, int order) {
  const Space space(facing_strips(n), order);
  core::LocalRun run(1, 2);
  const NodeSet nodes = gauss_nodes(space);
  return errors_of(space, nodes.P * solved(nodes, collocation(space, nodes, FlatlandKernel(), inner_points, run)));
}

double largest_error_at_vertices(int n, int order) {
  const Space space(facing_strips(n), order);
  core::LocalRun run(1, 2);
  const NodeSet nodes = end_nodes(space);
  const Eigen::VectorXd B = solved(nodes, collocation(space, nodes, FlatlandKernel(), inner_points, run));
  double largest = 0;
  for (Index a = 0; a < B.size(); ++a)
    largest = std::max(largest, std::abs(B[a] - exact()(nodes.position[static_cast<std::size_t>(a)])));
  return largest;
}

struct Row {
  int order;
  double L2, nodal, iterated, functional;  ///< orders
  double L2_at_32, functional_at_32;       ///< errors
};

/// Orders from n = 16 to 32; where rounding is reached before, from the last pair of meshes above it.
void expect_table(Errors (*solve)(int n, int order), const Row& row) {
  const std::array<Errors, 4> at{solve(4, row.order), solve(8, row.order), solve(16, row.order), solve(32, row.order)};
  const auto order = [&](double Errors::*what) {
    std::size_t last = 3;
    while (last > 1 && at[last].*what < 2e-13) --last;
    return std::log2(at[last - 1].*what / at[last].*what);
  };
  EXPECT_NEAR(order(&Errors::L2), row.L2, .05) << row.order;
  EXPECT_NEAR(order(&Errors::nodal), row.nodal, .05) << row.order;
  EXPECT_NEAR(order(&Errors::iterated), row.iterated, .05) << row.order;
  EXPECT_NEAR(order(&Errors::functional), row.functional, .05) << row.order;
  EXPECT_NEAR(at[3].L2 / row.L2_at_32, 1, 1e-3) << row.order;
  EXPECT_NEAR(at[3].functional, row.functional_at_32, 1e-3 * row.functional_at_32 + 1e-14) << row.order;
}

// Nodes are the Gauss points; p = 1 has order 3 there by Galerkin's method, and 4 by collocation.
TEST(FlatlandStrips, orders_of_galerkin_are_those_of_the_table) {
  expect_table(by_galerkin, {0, 1, 2, 2, 2, 5.882e-3, 3.720e-5});
  expect_table(by_galerkin, {1, 2, 2.98, 4, 4, 7.553e-5, 6.024e-9});
  expect_table(by_galerkin, {2, 3, 4.01, 6, 6, 6.549e-7, 4.734e-13});
}

TEST(FlatlandStrips, orders_of_collocation_at_gauss_points_are_those_of_the_table) {
  expect_table(by_collocation, {0, 1, 1.99, 2, 2, 5.883e-3, 9.906e-5});
  expect_table(by_collocation, {1, 2, 4, 4, 4, 7.553e-5, 1.145e-8});
  expect_table(by_collocation, {2, 3, 6.01, 6.01, 6.03, 6.550e-7, 6.275e-13});
}

// Interpolation at vertices integrates polynomials of degree 1 and no more, where that at Gauss points has degree 3;
// with the middle, Simpson's rule, degree 3.
TEST(FlatlandStrips, collocation_at_vertices_gains_less) {
  EXPECT_NEAR(std::log2(largest_error_at_vertices(16, 1) / largest_error_at_vertices(32, 1)), 2, .05);
  EXPECT_NEAR(std::log2(largest_error_at_vertices(16, 2) / largest_error_at_vertices(32, 2)), 4, .05);
}

TEST(FlatlandStrips, collocation_of_constants_has_no_vertices) {
  EXPECT_THROW(end_nodes(Space(facing_strips(2), 0)), core::PreconditionError);
}

// A solver that knows nothing of light gives the same: G is the identity, K is not symmetric.
TEST(FlatlandStrips, collocation_is_an_operator_that_solvers_take) {
  const Space space(facing_strips(8), 1);
  core::LocalRun run(1, 2);
  const NodeSet nodes = gauss_nodes(space);
  const NodeOperator T = collocation(space, nodes, FlatlandKernel(), inner_points, run);
  solvers::ColumnMatrix e(T.layout().unknowns(), 1);
  for (Index a = 0; a < e.rows(); ++a) e(a, 0) = strip_exitance(nodes.position[static_cast<std::size_t>(a)]);
  const solvers::Reflection R(solvers::ColumnMatrix::Constant(e.rows(), 1, rho));
  const Eigen::VectorXd expected = solved(nodes, T);
  for (const std::string& name : solvers::solver_names(false)) {
    if (name == "conjugate-gradients" || name == "southwell" || name == "progressive") continue;  // K is not symmetric
    solvers::SolverState state{e, 0};
    const auto report = solvers::make_solver(name)->advance({T, R, e}, state, {1e-13, 1000}, run);
    EXPECT_TRUE(report.converged()) << name;
    EXPECT_LT((state.x.col(0) - expected).cwiseAbs().maxCoeff(), 1e-11) << name;
  }
}

}  // namespace
}  // namespace interflect::fem

#include "fem/varying_reflectance.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "core/error.h"
#include "fem/galerkin.h"
#include "fem/operator/dense_symmetric.h"
#include "solvers/solver.h"
#include "tests/fem/rooms.h"
#include "tests/fem/space/facing_strips.h"

namespace interflect::fem {
namespace {

using test::ExactStrips;
using test::facing_strips;
using test::strip_exitance;

/// Reflectance that varies along both strips, and inside every element.
double rho_along(double x) { return .5 + .4 * std::sin(7 * x); }
double rho_at(const Vec3& x) { return rho_along(x.x()); }

struct Errors {
  double L2, functional;
};

/// @param mean  one number an element in the place of what varies
Errors errors_of(int n, int order, bool mean) {
  static const ExactStrips exact(rho_along);
  const Space space(facing_strips(n), order);
  test::LastEntrySink sink(space.gram().size());
  core::LocalRun run(1, 2);
  galerkin(space, FlatlandKernel(), ProductPairRule(14), sink, run.get());
  const Eigen::Map<const Eigen::VectorXd> G(space.gram().data(), sink.K.rows());
  const solvers::Reflection R = varying_reflectance(
      space,
      [&](Index panel, const Vec3& x) {
        if (!mean) return Spectrum(rho_at(x));
        const PanelNodes at = space.nodes(panel, 8);
        double sum = 0;
        for (std::size_t q = 0; q < at.weight.size(); ++q) sum += at.weight[q] * rho_at(at.position[q]);
        return Spectrum(sum / space.panel(panel).measure);
      },
      1, 8);
  Eigen::MatrixXd blocks = Eigen::MatrixXd::Zero(sink.K.rows(), sink.K.rows());
  for (const solvers::Reflection::Block& block : R.blocks())
    blocks.block(block.first, block.first, block.of_channel[0].rows(), block.of_channel[0].rows()) =
        block.of_channel[0];
  const Eigen::MatrixXd A = Eigen::MatrixXd::Identity(blocks.rows(), blocks.rows()) -
                            blocks * (G.cwiseInverse().asDiagonal() * sink.K).eval();
  const Eigen::VectorXd c =
      A.partialPivLu().solve(space.project([](Index, const Vec3& x) { return strip_exitance(x); }, order + 1));
  Errors errors{space.distance(
                    c, [](Index, const Vec3& x) { return exact(x); }, 10),
                0};
  for (Index i = 0; i < std::ssize(space.panels()); ++i) {
    const PanelNodes at = space.nodes(i, 10);
    for (std::size_t q = 0; q < at.weight.size(); ++q) errors.functional -= at.weight[q] * exact(at.position[q]);
    errors.functional += space.panel(i).measure * c[space.first(i)];
  }
  errors.functional = std::abs(errors.functional);
  return errors;
}

// Inside the integral, reflectance that varies costs no order.  As a mean of elements it costs all but the first.
TEST(VaryingReflectance, keeps_the_orders_of_galerkin) {
  for (const int order : {0, 1, 2}) {
    const Errors coarse = errors_of(8, order, false), fine = errors_of(16, order, false);
    EXPECT_NEAR(std::log2(coarse.L2 / fine.L2), order + 1, .1) << order;
    EXPECT_NEAR(std::log2(coarse.functional / fine.functional), 2 * order + 2, .15) << order;
  }
}
TEST(VaryingReflectance, as_a_mean_of_elements_leaves_the_first_order_alone) {
  const Errors coarse = errors_of(8, 2, true), fine = errors_of(16, 2, true);
  EXPECT_NEAR(std::log2(coarse.L2 / fine.L2), 1, .1);
}

// Linear reflectance on any panel: the block is the integral of a polynomial, which more points do not change; and a
// constant is the identity's multiple.
TEST(VaryingReflectance, has_exact_blocks) {
  const std::vector<Panel> panels{{{Vec3(0, 0, 0), Vec3(3, 0, 1), Vec3(1, 2, 0), Vec3(0, 0, 0)},
                                   3,
                                   Vec3(3, 0, 1).cross(Vec3(1, 2, 0)).normalized(),
                                   .5 * Vec3(3, 0, 1).cross(Vec3(1, 2, 0)).norm()},
                                  {{Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(1.5, 1, 0), Vec3(.2, 1.4, 0)},
                                   4,
                                   Vec3::UnitZ(),
                                   .5 * (Vec3(1.5, 1, 0).cross(Vec3(-1.8, 1.4, 0))).norm()}};
  for (const int order : {1, 2}) {
    const Space space(panels, order);
    const auto linear = [](Index, const Vec3& x) { return Spectrum(.3 + .1 * x.x() + .05 * x.y()); };
    const auto few = varying_reflectance(space, linear, 2, order + 2), more = varying_reflectance(space, linear, 2, 4);
    const auto same = varying_reflectance(
        space, [](Index, const Vec3&) { return Spectrum(.7); }, 1, 4);
    for (std::size_t i = 0; i < panels.size(); ++i) {
      const Eigen::MatrixXd& R = few.blocks()[i].of_channel[1];
      EXPECT_LT((R - more.blocks()[i].of_channel[1]).norm(), 1e-13);
      EXPECT_LT((R - R.transpose()).norm(), 1e-15);
      EXPECT_LT((same.blocks()[i].of_channel[0] - .7 * Eigen::MatrixXd::Identity(R.rows(), R.cols())).norm(), 1e-13);
    }
  }
}

// Jacobi's method solves with blocks what elimination does; Gauss-Seidel's says that it cannot.
TEST(VaryingReflectance, is_solved_for) {
  const Space space(facing_strips(6), 1);
  core::LocalRun run(1, 2);
  DenseSymmetric K({space.gram().begin(), space.gram().end()});
  galerkin(space, FlatlandKernel(), ProductPairRule(8), K, run.get());
  const solvers::Reflection R = varying_reflectance(
      space, [](Index, const Vec3& x) { return Spectrum(rho_at(x)); }, 1, 6);
  solvers::ColumnMatrix e = space.project([](Index, const Vec3& x) { return strip_exitance(x); }, 2);
  solvers::SolverState state{e, 0};
  ASSERT_TRUE(solvers::make_solver("jacobi")->advance({K, R, e}, state, {1e-14, 1000}, run.get()).converged());
  solvers::ColumnMatrix h(e.rows(), 1), b = e;
  K.apply(state.x, h, run.get());
  for (Index a = 0; a < e.rows(); ++a) h(a, 0) /= space.gram()[std::size_t(a)];
  R.add_reflected(h, b);
  EXPECT_LT((b - state.x).cwiseAbs().maxCoeff(), 1e-13);
  EXPECT_GT((R.blocks()[0].of_channel[0](0, 1)), 1e-3);
  EXPECT_THROW(solvers::make_solver("gauss-seidel")->advance({K, R, e}, state, {}, run.get()), core::InputError);
  const solvers::Reflection too_much = varying_reflectance(
      space, [](Index, const Vec3&) { return Spectrum(1.1); }, 1, 2);
  EXPECT_THROW(solvers::make_solver("jacobi")->advance({K, too_much, e}, state, {}, run.get()), core::InputError);
  const solvers::Reflection all = varying_reflectance(
      space, [](Index, const Vec3&) { return Spectrum(1.0); }, 1, 2);
  EXPECT_THROW(solvers::make_solver("jacobi")->advance({K, all, e}, state, {}, run.get()), core::InputError);
}

}  // namespace
}  // namespace interflect::fem

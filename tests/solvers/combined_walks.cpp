#include "solvers/combined_walks.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/solvers/six_faces.h"

namespace interflect::solvers {
namespace {

/// sum G / (N / V_s + n / V_g), for so many walks in all.
double left_by(const ColumnMatrix& shooting, const ColumnMatrix& gathering, std::span<const double> G, double shot,
               const Eigen::VectorXd& n, double walks) {
  const double unit = walks / (shot + n.sum());
  double sum = 0;
  for (Index i = 0; i < n.size(); ++i)
    sum += G[static_cast<std::size_t>(i)] / (unit * (shot / shooting(i, 0) + n(i) / gathering(i, 0)));
  return sum;
}

// The plan is better than shooting alone, than gathering alone, and than ten thousand that are near it.
TEST(WalkPlan, is_the_best_there_is) {
  core::RandomNumbers random(4, 0, 0);
  for (int trial = 0; trial < 20; ++trial) {
    const Index n = 8;
    const std::uint64_t seed = 100 + static_cast<std::uint64_t>(trial);
    const ColumnMatrix exponents = random_columns(n, 3, -2, 2, seed);
    ColumnMatrix shooting(n, 1), gathering(n, 1);
    std::vector<double> G;
    for (Index i = 0; i < n; ++i) {
      shooting(i, 0) = std::pow(10, exponents(i, 0)) * (trial % 2 == 0 ? 1 : 30);
      gathering(i, 0) = std::pow(10, exponents(i, 1));
      G.push_back(std::pow(10, exponents(i, 2)));
    }
    const WalkPlan plan = plan_walks(shooting, gathering, G, Eigen::RowVectorXd::Constant(1, 2.5));
    const double planned = left_by(shooting, gathering, G, 1, plan.gathered, 1000);
    EXPECT_LE(planned, left_by(shooting, gathering, G, 1, Eigen::VectorXd::Zero(n), 1000) * (1 + 1e-9));
    Eigen::VectorXd alone(n);
    for (Index i = 0; i < n; ++i) alone(i) = std::sqrt(G[std::size_t(i)] * gathering(i, 0));
    EXPECT_LE(planned, left_by(shooting, gathering, G, 0, alone, 1000) * (1 + 1e-4));
    for (int k = 0; k < 10000; ++k) {
      Eigen::VectorXd near = plan.gathered;
      for (Index i = 0; i < n; ++i) near(i) = std::max(0.0, near(i) * (.5 + random.next()) + .1 * (random.next() - .5));
      ASSERT_LE(planned, left_by(shooting, gathering, G, 1, near, 1000) * (1 + 1e-4)) << trial << ' ' << k;
    }
  }
}

/// What is left of variance by so many repetitions, a draw: sum G variance * draws.
double work_of(const std::string& name, const FullOperator& K, const ColumnMatrix& rho, const ColumnMatrix& e,
               const ColumnMatrix& exact) {
  const MatrixSampler walks(K);
  const Reflection R(rho);
  SolverSettings settings;
  settings.replications = 200;
  StoppingRule rule;
  rule.samples = 200 * 4000;
  core::LocalRun run(6, 2);
  SolverState state{e};
  const SolverReport report = make_solver(name, settings)->advance({K, R, e, &walks}, state, rule, run);
  const Eigen::Map<const Eigen::VectorXd> G(K.gram().data(), e.rows());
  for (Index i = 0; i < e.rows(); ++i)
    EXPECT_NEAR(state.x(i, 0), exact(i, 0), 4.5 * state.standard_error(i, 0) + 1e-12) << name << i;
  return G.dot(state.standard_error.cwiseAbs2().col(0)) * report.rows();
}

// Areas over four decades and one small lamp: shooting finds small elements seldom, gathering finds the lamp seldom.
// Both together leave less than each alone.
// The number of walks that is asked for is that of both kinds, whatever the plan would like; a walk has about 1 / (1 -
// rho) = 2 draws.  What finds the variances comes on top: 72 of each unknown, and bounces of less than 4 000.
TEST(CombinedWalks, take_as_many_walks_as_they_are_asked_for) {
  const FullOperator K = random_operator(4, 71);
  const MatrixSampler walks(K);
  const ColumnMatrix e = ColumnMatrix::Ones(4, 1);
  const Reflection R(ColumnMatrix::Constant(4, 1, .5));
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    core::LocalRun run(seed, 1);
    SolverState state{e};
    StoppingRule rule;
    rule.samples = 12'800;
    const SolverReport report = make_solver("shooting-and-gathering")->advance({K, R, e, &walks}, state, rule, run);
    EXPECT_LE(report.rows(), 2.2 * 12'800 + 4 * 72 + 4'000) << seed;
    EXPECT_GE(report.rows(), 0.5 * 12'800) << seed;
  }
}

TEST(CombinedWalks, are_better_than_either) {
  const Index n = 30;
  FullOperator K = random_operator(n, 51);
  const ColumnMatrix rho = random_columns(n, 1, .2, .8, 52);
  ColumnMatrix e = random_columns(n, 1, 0, .05, 53);
  e(3, 0) = 1;
  const ColumnMatrix exact = by_elimination(K, rho, e);
  const double together = work_of("shooting-and-gathering", K, rho, e, exact);
  const double by_shooting = work_of("shooting-collision", K, rho, e, exact),
               by_gathering = work_of("gathering-collision", K, rho, e, exact);
  EXPECT_LT(together, .9 * by_shooting);
  EXPECT_LT(together, .9 * by_gathering);
}

}  // namespace
}  // namespace interflect::solvers

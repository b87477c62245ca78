#include "solvers/power_transfer.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "core/error.h"
#include "core/moments.h"
#include "solvers/constant_control_variate.h"
#include "solvers/line_transfer.h"
#include "solvers/ray_transfer.h"
#include "tests/solvers/six_faces.h"

namespace interflect::solvers {
namespace {

// docs/truths.md 1.18: the variance of a ray, of one bounce of the solution.  By 400 000 rays within five of its own
// standard errors, sqrt(kurtosis / n), about 1 %.
/// What single rays say of one bounce of a power, per face.
std::array<core::ScalarMoments, 6> scores_of(const SampledBounce& transfer, std::uint64_t seed) {
  const auto sequence = core::make_sequence("independent", seed);
  std::array<core::ScalarMoments, 6> scores;
  ColumnMatrix reflected(6, 1);
  for (std::uint64_t k = 0; k < 400000; ++k) {
    reflected.setZero();
    transfer.add(*sequence, k, 1, 1, reflected);
    for (Index i = 0; i < 6; ++i) scores[std::size_t(i)].add(reflected(i, 0));
  }
  return scores;
}
/// Of the cube's solution, whose faces have areas of 1.
ColumnMatrix power_of_cube() { return Eigen::Map<const Eigen::VectorXd>(radiosity, 6); }

TEST(PowerTransfer, has_the_mean_and_the_variance_that_are_known) {
  const SixFaces cube;
  const System system = cube.system();
  const ColumnMatrix power = power_of_cube();
  const auto scores = scores_of(PowerTransfer(system, power), 3);
  constexpr double known[6] = {.22878637, .88904506, 1.36942892, 1.94447173, 2.25557166, 2.40842172};
  for (Index i = 0; i < 6; ++i) {
    const core::ScalarMoments& score = scores[std::size_t(i)];
    EXPECT_NEAR(score.mean(), radiosity[i] - cube.e(i, 0), 4.5 * score.standard_error()) << i;
    EXPECT_NEAR(score.variance() / known[i], 1, .03) << i;
  }
}

// Lines that carry light both ways: the same means, and a variance that is known too, and smaller.
TEST(PowerTransfer, carries_light_both_ways) {
  const SixFaces cube;
  const System system = cube.system();
  const ColumnMatrix power = power_of_cube();
  const auto scores = scores_of(PowerTransfer(system, power, PowerTransfer::Lines::both_ways), 4);
  for (Index i = 0; i < 6; ++i) {
    const core::ScalarMoments& score = scores[std::size_t(i)];
    const double rho = cube.rho(i, 0), b = radiosity[i] - cube.e(i, 0);
    double sum = 0;
    for (Index j = 0; j < 6; ++j)
      sum += cube.K.matrix()(i, j) * power(j, 0) * power(j, 0) / (power(i, 0) + power(j, 0));
    const double known = rho * rho * power.sum() * sum - b * b;
    EXPECT_NEAR(score.mean(), b, 4.5 * score.standard_error()) << i;
    EXPECT_NEAR(score.variance() / known, 1, .03) << i;
    EXPECT_LT(known, rho * power.sum() * b - b * b) << "one way";
  }
}

// Lines through everything: light of all elements on an equal footing, wherever it comes from.
TEST(LineTransfer, has_the_mean_and_the_variance_that_are_known) {
  const SixFaces cube;
  const System system = cube.system();
  const ColumnMatrix power = power_of_cube();
  const auto scores = scores_of(LineTransfer(system, power), 5);
  for (Index i = 0; i < 6; ++i) {
    const core::ScalarMoments& score = scores[std::size_t(i)];
    const double rho = cube.rho(i, 0), b = radiosity[i] - cube.e(i, 0), M = cube.K.matrix().sum();
    const double known = .5 * rho * rho * M * (cube.K.matrix().row(i) * power.cwiseAbs2())(0) - b * b;
    EXPECT_NEAR(score.mean(), b, 4.5 * score.standard_error()) << i;
    EXPECT_NEAR(score.variance() / known, 1, .03) << i;
  }
}

// Less a constant: a variance by |B - beta|, with beta the median by area, which is less.
TEST(ConstantControlVariate, has_the_mean_and_the_variance_that_are_known) {
  const SixFaces cube;
  const System system = cube.system();
  const ColumnMatrix power = power_of_cube();
  const ConstantControlVariate transfer(system, power, ray_transfer(system));
  EXPECT_EQ(transfer.constant()(0), power(2, 0)) << "the third of six";
  const Eigen::VectorXd left = (power.array() - transfer.constant()(0)).abs();
  const auto scores = scores_of(transfer, 6);
  double less = 0, more = 0;
  for (Index i = 0; i < 6; ++i) {
    const core::ScalarMoments& score = scores[std::size_t(i)];
    const double rho = cube.rho(i, 0), b = radiosity[i] - cube.e(i, 0), by_rays = b - rho * transfer.constant()(0);
    const double known = rho * rho * left.sum() * cube.K.matrix().row(i).dot(left) - by_rays * by_rays;
    EXPECT_NEAR(score.mean(), b, 4.5 * score.standard_error()) << i;
    EXPECT_NEAR(score.variance() / known, 1, .03) << i;
    less += known, more += rho * power.sum() * b - b * b;
  }
  EXPECT_LT(less, .75 * more);
}

TEST(ConstantControlVariate, is_of_closed_rooms) {
  const FullOperator closed = random_operator(9, 3);
  const Eigen::VectorXd areas = Eigen::Map<const Eigen::VectorXd>(closed.gram().data(), 9);
  const FullOperator K(.9 * closed.matrix(), areas);
  const MatrixSampler walks(K);
  const ColumnMatrix rho = random_columns(9, 1, .1, .9, 4);
  const Reflection R(rho);
  SolverState state{rho};
  core::LocalRun run;
  EXPECT_THROW(make_solver("control-variate-stochastic-jacobi")->advance({K, R, rho, &walks}, state, {}, run),
               core::InputError);
}

// Of many short solves: none is off in the mean, however few rays its last bounces have.
TEST(StochasticJacobi, is_unbiased_with_few_rays) {
  const SixFaces cube;
  for (const char* name : {"stochastic-jacobi", "regular-stochastic-jacobi", "bidirectional-stochastic-jacobi",
                           "control-variate-stochastic-jacobi", "global-line-stochastic-jacobi", "stochastic-ray"})
    for (const char* sequence : {"independent", "stratified", "sobol"}) {
      SolverSettings settings;
      settings.replications = 4000;
      settings.sequence = sequence;
      StoppingRule rule;
      rule.samples = 4000 * 60;
      core::LocalRun run(2, 2);
      SolverState state{cube.e};
      make_solver(name, settings)->advance(cube.system(), state, rule, run);
      for (Index i = 0; i < 6; ++i)
        EXPECT_NEAR(state.x(i, 0), radiosity[i], 4.5 * state.standard_error(i, 0)) << name << ' ' << sequence << i;
    }
}

// Noise falls with the rays: 16 times as many, a quarter of it.
TEST(StochasticJacobi, is_a_quarter_as_noisy_by_sixteen_times_the_rays) {
  const SixFaces cube;
  for (const char* name : {"stochastic-jacobi", "regular-stochastic-jacobi", "bidirectional-stochastic-jacobi",
                           "control-variate-stochastic-jacobi", "global-line-stochastic-jacobi", "stochastic-ray"}) {
    double noise[2];
    for (const int more : {0, 1}) {
      SolverSettings settings;
      settings.replications = 400;
      StoppingRule rule;
      rule.samples = 400u * 1024u * (more ? 16u : 1u);
      core::LocalRun run(7, 2);
      SolverState state{cube.e};
      noise[more] = make_solver(name, settings)->advance(cube.system(), state, rule, run).residual();
    }
    EXPECT_NEAR(noise[0] / noise[1], 4, .8) << name;
  }
}

}  // namespace
}  // namespace interflect::solvers

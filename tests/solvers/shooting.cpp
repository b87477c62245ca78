#include "solvers/shooting.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "solvers/bounce.h"
#include "solvers/progressive.h"
#include "solvers/southwell.h"
#include "solvers/system_check.h"
#include "tests/solvers/random_systems.h"

namespace interflect::solvers {
namespace {

/// A random system on areas over four decades.
struct Problem {
  explicit Problem(Index n, Index columns = 1, std::uint64_t seed = 41)
      : K(random_operator(n, seed)),
        rho(random_columns(n, columns, 0, .9, seed + 1)),
        e(random_columns(n, columns, 0, 1, seed + 2)),
        R(rho) {}
  System system() const { return {K, R, e}; }

  FullOperator K;
  ColumnMatrix rho, e;
  Reflection R;
};

SolverReport advance(const RadiositySolver& solver, const System& system, SolverState& state,
                     const StoppingRule& rule = {}) {
  core::LocalRun run(1, 1);
  return solver.advance(system, state, rule, run);
}

/// By the full matrix, of all that is.
Index brightest(const ColumnMatrix& r, std::span<const double> G) {
  Index best = 0;
  for (Index a = 1; a < r.rows(); ++a)
    if (G[static_cast<std::size_t>(a)] * r.row(a).cwiseAbs().sum() >
        G[static_cast<std::size_t>(best)] * r.row(best).cwiseAbs().sum())
      best = a;
  return best;
}

TEST(Shooting, goes_by_the_largest_residual_of_all) {
  for (const Index columns : {1, 3}) {
    const Problem problem(90, columns);
    core::LocalRun run(1, 1);
    Shooting shooting = begin_shooting(problem.system(), "southwell", {problem.e}, run);
    for (int step = 0; step < 700; ++step) {
      const ColumnMatrix r = residual_of(problem.system(), shooting.x(), run);
      ASSERT_EQ(shooting.brightest(), brightest(r, problem.K.gram())) << step;
      shooting.relax(shooting.brightest());
    }
  }
}

// r = e + R G^-1 K x - x after every step of either kind, whatever is shot.
TEST(Shooting, keeps_the_residual_true) {
  const Problem problem(60, 2);
  core::LocalRun run(1, 1);
  for (const bool relaxed : {true, false}) {
    Shooting shooting = begin_shooting(problem.system(), "progressive", {problem.e}, run);
    for (int step = 0; step < 3000; ++step) {
      const Index i = shooting.brightest();
      if (relaxed) {
        shooting.relax(i);
        ASSERT_EQ(shooting.unshot(i).cwiseAbs().maxCoeff(), 0) << step;
      } else {
        shooting.step(i, 1.3 * shooting.unshot(i));
      }
      const ColumnMatrix x = shooting.x(), r = residual_of(problem.system(), x, run);
      ASSERT_LE((shooting.residual() - r).cwiseAbs().maxCoeff(), 1e-13 * x.cwiseAbs().maxCoeff()) << step;
      if (step % 100 == 0) {
        ASSERT_NEAR(shooting.relative_residual(), relative_size(r, x), 1e-13);
      }
    }
  }
}

TEST(Shooting, takes_the_first_of_equal_ones) {
  Eigen::MatrixXd K = Eigen::MatrixXd::Constant(6, 6, 1. / 6);
  const FullOperator equal(K, Eigen::VectorXd::Ones(6));
  const ColumnMatrix e = ColumnMatrix::Ones(6, 1);
  const Reflection R(.5 * e);
  core::LocalRun run(1, 1);
  Shooting shooting = begin_shooting({equal, R, e}, "southwell", {e}, run);
  for (const Index expected : {0, 1, 2, 3, 4, 5}) {
    ASSERT_EQ(shooting.brightest(), expected);
    shooting.relax(expected);
  }
}

// Many unknowns, a few of which can be seen at a time: more than one chunk, the same bits.
TEST(Shooting, has_the_same_bits_for_any_number_of_threads) {
  const Problem problem(4200, 1);
  ColumnMatrix first;
  for (const unsigned threads : {1u, 2u, 8u}) {
    core::LocalRun run(1, threads);
    Shooting shooting = begin_shooting(problem.system(), "southwell", {problem.e}, run);
    for (int step = 0; step < 60; ++step) shooting.relax(shooting.brightest());
    if (first.size() == 0) first = shooting.x();
    EXPECT_EQ(shooting.x(), first) << threads;
  }
}

TEST(Southwell, says_in_one_line_what_it_needs) {
  for (const bool with_rows : {true, false}) {
    Problem problem(10);
    problem.K.with_rows = with_rows;
    problem.K.says_symmetric = !with_rows;
    for (const char* name : {"southwell", "progressive"}) {
      SolverState state{problem.e};
      try {
        advance(*make_solver(name), problem.system(), state);
        FAIL() << "an InputError expected";
      } catch (const core::InputError& error) {
        EXPECT_EQ(core::single_line(error.what()), error.what());
        EXPECT_NE(std::string(error.what()).find(with_rows ? "symmetric" : "rows"), std::string::npos);
      }
    }
  }
}

// What is shot and what is not are one bounce of what is shot.
TEST(Progressive, is_one_bounce_ahead_of_what_was_shot) {
  const Problem problem(50, 2);
  SolverState state{problem.e};
  SolverSettings few;
  few.steps = 37;
  advance(Progressive(few), problem.system(), state, {.max_iterations = 1});
  core::LocalRun run(1, 1);
  const ColumnMatrix bounce = bounced(problem.system(), state.x, run);
  EXPECT_LE((state.x + state.residual - bounce).cwiseAbs().maxCoeff(), 1e-13 * bounce.maxCoeff());
}

// In a closed room of one reflectance the mean of all light is sum G e / (1 - rho), and what is shown has it from the
// first step on, with overshooting too.
TEST(Progressive, shows_all_the_light_that_there_will_be) {
  const FullOperator open = random_operator(80, 43);
  const FullOperator K(open.matrix(), open.matrix().rowwise().sum());
  const Eigen::Map<const Eigen::VectorXd> G(K.gram().data(), 80);
  ColumnMatrix e = random_columns(80, 1, 0, 1, 44);
  const Reflection R(ColumnMatrix::Constant(80, 1, .7));
  const System system{K, R, e};
  const double all = G.dot(e.col(0)) / .3;
  for (const double overshoot : {0.0, .5, 1.0}) {
    SolverSettings settings;
    settings.steps = 1;
    settings.overshoot = overshoot;
    SolverState state{e};
    state.observer = [&](const SolverState& now, const SolverReport&) {
      EXPECT_NEAR(G.dot(for_display(system, now).col(0)), all, 1e-11 * all);
    };
    const SolverReport report =
        advance(Progressive(settings), system, state, {.tolerance = 1e-9, .max_iterations = 200000});
    EXPECT_TRUE(report.converged()) << overshoot << " " << report.residual();
    EXPECT_EQ(report.rows(), report.iterations());
  }
}

// Ambient light is what makes a picture of the first steps: nearer to the end than what was shot.
TEST(Progressive, shows_more_of_the_truth_than_it_has) {
  const Problem problem(200);
  const ColumnMatrix exact = by_elimination(problem.K, problem.rho, problem.e);
  SolverSettings settings;
  settings.steps = 20;
  SolverState state{problem.e};
  advance(Progressive(settings), problem.system(), state, {.max_iterations = 1});
  const double shown = (for_display(problem.system(), state) - exact).norm(), shot = (state.x - exact).norm();
  EXPECT_LT(shown, .5 * shot);
}

TEST(Progressive, goes_on_from_its_state_to_the_same_bits) {
  const Problem problem(70, 3);
  for (const double overshoot : {0.0, .5}) {
    SolverSettings settings;
    settings.steps = 11;
    settings.overshoot = overshoot;
    SolverState at_once{problem.e}, in_parts{problem.e};
    advance(Progressive(settings), problem.system(), at_once, {.max_iterations = 9});
    for (int part = 0; part < 3; ++part) {
      SolverState saved{in_parts.x, in_parts.step, in_parts.residual};
      advance(Progressive(settings), problem.system(), saved, {.max_iterations = 3});
      in_parts = saved;
    }
    EXPECT_EQ(in_parts.x, at_once.x);
    EXPECT_EQ(in_parts.residual, at_once.residual);
    EXPECT_EQ(in_parts.step, 9);
  }
}

TEST(Progressive, stops_where_little_is_unshot) {
  const Problem problem(100);
  SolverState state{problem.e};
  const SolverReport report = advance(Progressive(), problem.system(), state, {.unshot = .01});
  EXPECT_EQ(report.why, SolverReport::Stopped::converged);
  const Eigen::Map<const Eigen::VectorXd> G(problem.K.gram().data(), 100);
  const double unshot = G.dot(state.residual.col(0).cwiseAbs()) / G.dot(problem.e.col(0));
  EXPECT_LE(unshot, .01);
  EXPECT_GT(unshot, .005);  // a step less had more
}

}  // namespace
}  // namespace interflect::solvers

#include "solvers/shooting.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/format.h"
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

/// K_ab = G_a G_b (1 + s_a s_b) / (2 sum G), |s| <= 1, made row by row when asked for: rows at most G_a, and as many as
/// one likes.  G and s repeat, so that unknowns are alike.
class RepeatedOperator final : public TransportOperator, public RowAccess {
 public:
  RepeatedOperator(Index of_one, Index times)
      : G_(Eigen::pow(10.0, random_columns(of_one, 1, -1, 1, 45).array()).matrix().replicate(times, 1)),
        s_(random_columns(of_one, 1, -1, 1, 46).replicate(times, 1)),
        self_(G_.cwiseAbs2().cwiseProduct((1 + s_.array().square()).matrix()) / (2 * G_.sum())),
        layout_(Layout::uniform(of_one * times, 1)) {}

  const Layout& layout() const override { return layout_; }
  bool symmetric() const override { return true; }
  void apply(ConstColumns b, Columns out, Run&) const override {
    const Eigen::VectorXd t = G_.cwiseProduct(s_);
    out = (G_ * (G_.transpose() * b) + t * (t.transpose() * b)) / (2 * G_.sum());
  }
  std::span<const double> gram() const override { return {G_.data(), static_cast<std::size_t>(G_.size())}; }
  std::span<const double> self() const override { return {self_.data(), static_cast<std::size_t>(self_.size())}; }
  const RowAccess* rows() const override { return this; }
  void rows(Index first, Index count, Columns out) const override {
    const double all = 2 * G_.sum();
    for (Index k = 0; k < count; ++k) {
      const double G = G_(first + k), s = s_(first + k);
      out.row(k) =
          ((G * G_.array()) * (1 + s * s_.array()) / all).matrix().transpose();  // the same as K_ba, to the bit
    }
  }
  Index evaluated() const override { return 0; }

 private:
  Eigen::VectorXd G_, s_, self_;
  Layout layout_;
};

/// Three chunks of unknowns (shooting.cpp), each of which is there three times, in two or three of them.
struct LargeProblem {
  static constexpr Index chunk = 4096, of_one = 3000, times = 3;
  LargeProblem()
      : K(of_one, times),
        e(random_columns(of_one, 2, 0, 1, 47).replicate(times, 1)),
        R(random_columns(of_one, 2, 0, .9, 48).replicate(times, 1)) {}
  System system() const { return {K, R, e}; }
  /// How many of a chunk have shot.
  static Index moved(const ColumnMatrix& x, Index which) {
    const Index first = which * chunk;
    return (x.col(0).segment(first, std::min(chunk, x.rows() - first)).array() != 0).count();
  }

  RepeatedOperator K;
  ColumnMatrix e;
  Reflection R;
};

TEST(Shooting, takes_the_first_of_equal_ones_of_several_chunks) {
  const LargeProblem problem;
  for (const unsigned threads : {1u, 2u, 8u}) {
    core::LocalRun run(1, threads);
    Shooting shooting = begin_shooting(problem.system(), "southwell", {problem.e}, run);
    for (int step = 0; step < 60; ++step) {
      ASSERT_EQ(shooting.brightest(), brightest(shooting.residual(), problem.K.gram())) << step;
      shooting.relax(shooting.brightest());
    }
    for (const Index which : {0, 1, 2}) EXPECT_GT(LargeProblem::moved(shooting.x(), which), 0) << which;
  }
}

// Of more unknowns than a thread takes at a time.
TEST(Shooting, has_the_same_bits_for_any_number_of_threads) {
  struct Kind {
    const char* solver;
    double overshoot;
  };
  const LargeProblem problem;
  for (const Kind& kind :
       {Kind{"southwell", 0}, Kind{"progressive", 0}, Kind{"progressive", .5}, Kind{"progressive", 1}}) {
    SolverSettings settings;
    settings.steps = 50;
    settings.overshoot = kind.overshoot;
    const auto solve = [&](unsigned threads) {
      core::LocalRun run(1, threads);
      SolverState state{problem.e};
      const SolverReport report =
          make_solver(kind.solver, settings)->advance(problem.system(), state, {.max_iterations = 3}, run);
      return std::pair(state, report.history);
    };
    const std::string which = core::format("%s, overshoot %g", kind.solver, kind.overshoot);
    const auto [one, history] = solve(1);
    core::LocalRun run(1, 1);
    const ColumnMatrix r = residual_of(problem.system(), one.x, run);
    EXPECT_LE((one.residual - r).cwiseAbs().maxCoeff(), 1e-13 * one.x.cwiseAbs().maxCoeff()) << which;
    for (const Index chunk : {0, 1, 2}) EXPECT_GT(LargeProblem::moved(one.x, chunk), 0) << which << ", chunk " << chunk;
    for (const unsigned threads : {2u, 3u, 8u}) {
      const auto [several, of_several] = solve(threads);
      EXPECT_EQ(several.x, one.x) << which << ", threads " << threads;
      EXPECT_EQ(several.residual, one.residual) << which << ", threads " << threads;
      EXPECT_EQ(of_several, history) << which << ", threads " << threads;
    }
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

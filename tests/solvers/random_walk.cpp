#include "solvers/random_walk.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "core/student_t.h"
#include "solvers/replications.h"
#include "tests/solvers/six_faces.h"

namespace interflect::solvers {
namespace {

struct Known {
  const char* solver;
  double variance[6];  ///< of a walk
};
constexpr Known known[] = {
    {"shooting-absorption", {.12057815, .69700518, 1.35068421, 2.50314136, 3.96801271, 6.41682538}},
    {"shooting-survival", {.71272076, 1.37836977, 1.68789528, 1.98044023, 1.95892863, 1.83746594}},
    {"shooting-collision", {.09895881, .4300906, .69177367, 1.01915989, 1.25512669, 1.40703791}},
    {"gathering-absorption", {.30740001, 1.19186259, 1.83394193, 2.60143518, 3.36852484, 2.66840062}},
    {"gathering-survival", {.11673245, .4574165, .70732368, 1.00805244, 1.24984307, 1.27945811}},
    {"gathering-collision", {.0774426, .30607307, .47516741, .67971247, .89362808, .88827224}},
};

/// Of 5 000 repetitions of 64 walks: means, and variances of a walk.
struct Sampled {
  ColumnMatrix x, variance;
};
constexpr int repetitions = 5000, walks_each = 64;
Sampled sampled(const std::string& name, const System& system) {
  SolverSettings settings;
  settings.replications = repetitions;
  StoppingRule rule;
  const bool gathers = name.rfind("gathering", 0) == 0;
  rule.samples = static_cast<std::uint64_t>(repetitions * walks_each * (gathers ? system.e.rows() : 1));
  core::LocalRun run(5, 2);
  SolverState state{system.e};
  EXPECT_TRUE(make_solver(name, settings)->advance(system, state, rule, run).converged());
  return {state.x, state.standard_error.cwiseAbs2() * repetitions * walks_each};
}

// Means within 4.5 standard errors.  A variance by 5 000 repetitions, whose sums of 64 walks are nearly normal, is off
// by sqrt(2 / 5000) = 2 %, somewhat more where scores are rare: 10 % are five of those. Each two scores differ by
// more in some face.
TEST(RandomWalks, have_the_variances_that_are_known) {
  const SixFaces cube;
  for (const Known& of : known) {
    const Sampled found = sampled(of.solver, cube.system());
    for (Index i = 0; i < 6; ++i) {
      const double variance = of.variance[i];
      EXPECT_NEAR(found.x(i, 0), radiosity[i], 4.5 * std::sqrt(variance / (repetitions * walks_each)))
          << of.solver << ' ' << i;
      EXPECT_NEAR(found.variance(i, 0) / variance, 1, .1) << of.solver << ' ' << i;
    }
    for (const Known& other : known) {  // a score in place of another would be seen
      if (other.solver == of.solver) continue;
      double furthest = 0;
      for (Index i = 0; i < 6; ++i)
        furthest = std::max(furthest, std::abs(found.variance(i, 0) / other.variance[i] - 1));
      EXPECT_GT(furthest, .1) << of.solver << " for " << other.solver;
    }
  }
}

/// Scores that an unknown can expect of a walk: hits, times the chance of going on or ending there.
double expected_scores(const std::string& name, const FullOperator& K, const ColumnMatrix& rho, const ColumnMatrix& e,
                       const ColumnMatrix& exact, Index i) {
  double hits = 0, reflected = 0;
  const Eigen::Map<const Eigen::VectorXd> G(K.gram().data(), e.rows());
  for (Index c = 0; c < e.cols(); ++c) {
    hits += G(i) * (exact(i, c) - e(i, c)) / rho(i, c) / G.dot(e.col(c)) / static_cast<double>(e.cols());
    reflected += rho(i, c) / static_cast<double>(e.cols());
  }
  return hits * (name == "shooting-survival" ? reflected : name == "shooting-absorption" ? 1 - reflected : 1);
}

// Unequal areas, several columns with reflectances of their own, an open room: means within what they state.  Of 200
// runs 95 % intervals hold the truth in 181 .. 197, pooled over unknowns that can expect 30 scores.
TEST(RandomWalks, state_their_errors) {
  const Index n = 12;
  FullOperator K = random_operator(n, 71);
  const MatrixSampler walks(K);
  const ColumnMatrix rho = random_columns(n, 2, .1, .9, 72), e = random_columns(n, 2, 0, 1, 73);
  const Reflection R(rho);
  const std::vector<double> all(n, 1);
  const System system{K, R, e, &walks, all};
  const ColumnMatrix exact = by_elimination(K, rho, e);
  using Needs = SolverEntry::Needs;
  for (const std::string& name : solver_names({Needs::walks, Needs::lines, Needs::points, Needs::target})) {
    double held = 0, asked = 0;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
      core::LocalRun run(seed, 2);
      SolverState state{e};
      StoppingRule rule;
      rule.samples = name.rfind("gathering", 0) == 0 ? 32 * 12 * 40 : 32 * 400;
      make_solver(name)->advance(system, state, rule, run);
      const double t = core::student_t(.95, 31);
      for (Index a = 0; a < n; ++a) {
        const bool gathers = name.rfind("gathering", 0) == 0;
        if (!gathers && 32 * 400 * expected_scores(name, K, rho, e, exact, a) < 30) continue;
        for (Index c = 0; c < 2; ++c) {
          held += std::abs(state.x(a, c) - exact(a, c)) <= t * state.standard_error(a, c) ? 1 : 0;
          ++asked;
        }
      }
    }
    EXPECT_GE(asked, 200 * 8) << name;
    EXPECT_GE(200 * held / asked, 181) << name;
    EXPECT_LE(200 * held / asked, 197) << name;
  }
}

TEST(RandomWalks, go_on_until_their_noise_is_small) {
  const SixFaces cube;
  for (const SolverEntry& solver : known_solvers()) {
    if (!solver.samples()) continue;
    core::LocalRun run(3, 2);
    SolverState state{cube.e};
    StoppingRule rule;
    rule.noise = 5e-3;
    const SolverReport report = solver.make({})->advance(cube.system(solver), state, rule, run);
    EXPECT_TRUE(report.converged());
    EXPECT_LE(report.residual(), 5e-3);
    EXPECT_GT(report.rows(), 1000);
    for (Index i = 0; i < 6; ++i)
      EXPECT_NEAR(state.x(i, 0), radiosity[i], 5 * state.standard_error(i, 0)) << solver.name;
  }
}

TEST(RandomWalks, are_the_same_for_any_number_of_threads) {
  const SixFaces cube;
  for (const SolverEntry& solver : known_solvers())
    for (const char* sequence : {"independent", "sobol"}) {
      if (!solver.samples()) continue;
      SolverSettings settings;
      settings.sequence = sequence;
      StoppingRule rule;
      rule.samples = 32 * 6 * 20;
      ColumnMatrix first;
      for (const unsigned threads : {1u, 2u, 3u, 8u}) {
        core::LocalRun run(4, threads);
        SolverState state{cube.e};
        solver.make(settings)->advance(cube.system(solver), state, rule, run);
        if (first.size() == 0) first = state.x;
        EXPECT_EQ(state.x, first) << solver.name << ' ' << threads;
      }
    }
}

TEST(RandomWalks, refuse_what_they_cannot_answer) {
  SixFaces cube;
  core::LocalRun run;
  const auto complaint = [&](const std::string& name, const System& system) {
    SolverState state{system.e};
    try {
      make_solver(name)->advance(system, state, {}, run);
    } catch (const core::InputError& error) {
      EXPECT_EQ(core::single_line(error.what()), error.what());
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(complaint("shooting-collision", {cube.K, *cube.R, cube.e}).find("rays"), std::string::npos);
  cube.rho(4, 0) = 0;
  EXPECT_NE(complaint("gathering-survival", {cube.K, Reflection(cube.rho), cube.e, &cube.walks}).find("source"),
            std::string::npos);
  cube.rho(4, 0) = 1;
  EXPECT_NE(complaint("shooting-absorption", {cube.K, Reflection(cube.rho), cube.e, &cube.walks}).find("absorbs"),
            std::string::npos);
  SolverSettings few;
  few.replications = 5;
  SolverState state{cube.e};
  EXPECT_THROW(make_solver("shooting-collision", few)->advance({cube.K, *cube.R, cube.e, &cube.walks}, state, {}, run),
               core::InputError);
}

TEST(StudentT, is_what_tables_have) {
  EXPECT_NEAR(core::student_t(.95, 1), 12.7062047, 1e-6);
  EXPECT_NEAR(core::student_t(.95, 2), 4.30265273, 1e-7);
  EXPECT_NEAR(core::student_t(.95, 9), 2.26215716, 1e-7);
  EXPECT_NEAR(core::student_t(.99, 31), 2.74404192, 1e-6);
  EXPECT_NEAR(core::student_t(.95, 10000), 1.96020126, 1e-6);
}

}  // namespace
}  // namespace interflect::solvers

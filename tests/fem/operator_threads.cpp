#include <gtest/gtest.h>

#include "solvers/solver.h"
#include "tests/fem/operator_fixtures.h"

using namespace interflect;
using namespace interflect::fem;

TEST(DenseSymmetricThreads, give_the_same_bits_whatever_their_number) {
  const Index n = 1100;
  const OperatorPair pair = random_pair(n, 11);
  const solvers::ColumnMatrix b = random_columns(n, 3, 12);
  solvers::ColumnMatrix product(n, 3), variance(n, 3);
  core::LocalRun one(1, 1);
  pair.K->apply(b, product, one);
  pair.K->apply_variances(b, variance, one);
  const auto cubes = [](Index a, Index, double K_ab) { return static_cast<double>(a % 7) * K_ab * K_ab * K_ab; };
  const double sum = pair.K->sum_over_entries(one.get(), cubes);
  for (const unsigned threads : {2u, 3u, 8u}) {
    core::LocalRun several(1, threads);
    solvers::ColumnMatrix out(n, 3);
    pair.K->apply(b, out, several);
    EXPECT_EQ(out, product) << threads;
    pair.K->apply_variances(b, out, several);
    EXPECT_EQ(out, variance) << threads;
    EXPECT_EQ(pair.K->sum_over_entries(several.get(), cubes), sum) << threads;
  }
}

// Rows of one tile from several threads, with errors: what assembly does.
TEST(DenseSymmetricThreads, may_write_distinct_pairs_at_the_same_time) {
  const Index n = 300;
  const OperatorPair pair = random_pair(n, 13);
  DenseSymmetric K(std::vector<double>(pair.areas.begin(), pair.areas.end()));
  core::LocalRun run(1, 8);
  run.get().threads.for_blocks(n, 1, [&](Index a, Index) {
    for (Index b = a; b < n; ++b) K.add(a, b, {pair.full(a, b), pair.errors(a, b)});
  });
  for (Index a = 0; a < n; ++a)
    for (Index b = 0; b < n; ++b) {
      ASSERT_EQ(K.entry(a, b), pair.full(a, b));
      ASSERT_EQ(K.entry_standard_error(a, b), pair.errors(a, b));
    }
}

// Both solvers on the same K, with areas over four decades.
TEST(DenseSymmetricThreads, serve_both_solvers_alike) {
  const Index n = 333;
  const OperatorPair pair = random_pair(n, 14, 4, true);
  const solvers::ColumnMatrix e = random_columns(n, 3, 15).cwiseAbs();
  const solvers::Reflection R(solvers::ColumnMatrix::Constant(n, 3, 0.9));
  std::vector<solvers::ColumnMatrix> answers;
  for (const std::string& name : solvers::solver_names(false))
    for (const unsigned threads : {1u, 3u}) {
      core::LocalRun run(1, threads);
      solvers::SolverState state;
      EXPECT_TRUE(solvers::make_solver(name)->advance({*pair.K, R, e}, state, {1e-14, 10000}, run).converged()) << name;
      answers.push_back(state.x);
    }
  EXPECT_EQ(answers[0], answers[1]);
  EXPECT_EQ(answers[2], answers[3]);
  EXPECT_LE((answers[0] - answers[2]).cwiseAbs().maxCoeff(), 2e-13 * answers[0].maxCoeff());  // 2 residuals / (1 - 0.9)
}

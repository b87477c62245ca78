#include "fem/closure.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "solvers/solver.h"
#include "tests/fem/operator_fixtures.h"

using namespace interflect;
using namespace interflect::fem;

namespace {

/// A closed K whose entries are off by up to `amount`, relative, symmetrically.
OperatorPair perturbed(Index n, double amount, std::uint64_t seed) {
  OperatorPair pair = random_pair(n, seed, 4, true, true);
  core::RandomNumbers random(seed, 2, 0);
  for (Index a = 0; a < n; ++a)
    for (Index b = a; b < n; ++b) {
      pair.full(a, b) *= 1 + amount * (2 * random.next() - 1);
      pair.full(b, a) = pair.full(a, b);
      pair.K->add(a, b, {pair.full(a, b), 0});
    }
  return pair;
}

double largest_error(const std::vector<double>& F) {
  double largest = 0;
  for (const double f : F) largest = std::max(largest, std::abs(f - 1));
  return largest;
}

}  // namespace

TEST(Closure, makes_row_sums_1_and_keeps_symmetry_positivity_and_zeros) {
  core::LocalRun run(1, 2);
  for (const double amount : {1e-6, 0.01, 0.5}) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const OperatorPair pair = perturbed(240, amount, seed);  // areas over four decades
      const ClosureReport report = restore_closure(*pair.K, run, {.largest_row_error = 1, .largest_correction = 1});
      EXPECT_TRUE(report.converged);
      EXPECT_LE(largest_error(pair.K->row_sums(run)), 1e-13);
      EXPECT_LE(report.row_error_after, 1e-13);
      EXPECT_GT(report.row_error_before, 1e-3 * amount);
      EXPECT_LE(report.iterations, 8);
      const Eigen::MatrixXd K = full(*pair.K);
      EXPECT_EQ(K, K.transpose());
      EXPECT_TRUE(((K.array() > 0) == (pair.full.array() > 0)).all());
      EXPECT_TRUE((K.array() >= 0).all());
      EXPECT_NEAR(report.correction, (K - pair.full).norm() / pair.full.norm(), 1e-10 * report.correction + 1e-14);
      EXPECT_LE(report.correction, amount);
    }
  }
}

// K is closed already: what comes out must be what went in, to rounding.
TEST(Closure, leaves_a_closed_operator_alone) {
  core::LocalRun run(1, 1);
  const OperatorPair pair = random_pair(130, 6, 4, true, true);
  const ClosureReport report = restore_closure(*pair.K, run);
  EXPECT_TRUE(report.converged);
  EXPECT_LE(report.correction, 1e-13);
  EXPECT_LE((full(*pair.K) - pair.full).norm(), 1e-13 * pair.full.norm());
}

// The correction is s_a s_b: K'_ab / K_ab is a product, so that every 2 x 2 minor of ratios is 1.  And it is the
// smallest to first order: against any other symmetric change with the same row sums on the same entries, sum (K' - K)²
// / K is no larger.
TEST(Closure, is_to_first_order_the_smallest_relative_change) {
  core::LocalRun run(1, 1);
  const double amount = 1e-5;
  const OperatorPair off = perturbed(60, amount, 7);
  restore_closure(*off.K, run);
  // The unperturbed matrix is another symmetric one with these row sums and zeros, near the perturbed one.
  const Eigen::MatrixXd K = full(*off.K), original = random_pair(60, 7, 4, true, true).full, start = off.full;
  EXPECT_LE((K.rowwise().sum() - original.rowwise().sum()).norm(), 1e-11 * original.rowwise().sum().norm());
  const auto cost = [&](const Eigen::MatrixXd& to) {
    double sum = 0;
    for (Index a = 0; a < 60; ++a)
      for (Index b = 0; b < 60; ++b)
        if (start(a, b) > 0) sum += std::pow(to(a, b) - start(a, b), 2) / start(a, b);
    return sum;
  };
  EXPECT_LT(cost(K), cost(original));
  for (const double t :
       {-0.5, -0.1, 0.1, 0.5})  // along the line between two feasible matrices the smallest is at t = 0, to O(amount)
    EXPECT_GT(cost(K + t * (original - K)), cost(K) * (1 - 10 * amount)) << t;
}

TEST(Closure, brings_a_perturbed_furnace_back_to_1_at_a_reflectance_of_95_percent) {
  core::LocalRun run(1, 2);
  const Index n = 200;
  const OperatorPair pair = perturbed(n, 0.05, 8);
  const solvers::ColumnMatrix rho = solvers::ColumnMatrix::Constant(n, 1, 0.95),
                              e = solvers::ColumnMatrix::Constant(n, 1, 0.05);
  const auto deviation = [&] {
    solvers::SolverState state;
    EXPECT_TRUE(solvers::make_solver("gauss-seidel")
                    ->advance({*pair.K, solvers::Reflection(rho), e}, state, {1e-13, 10000}, run)
                    .converged());
    return (state.x.array() - 1).abs().maxCoeff();
  };
  EXPECT_GT(deviation(), 1e-4) << "the test would not see anything";
  restore_closure(*pair.K, run);
  EXPECT_LE(deviation(), 1e-10);
}

// Two plates that see each other only, as in the gap between infinite ones: the system for the scaling is singular, and
// consistent since their areas are equal.
TEST(Closure, works_where_elements_form_two_groups_that_see_each_other_only) {
  core::LocalRun run(1, 1);
  const Index n = 80;
  core::RandomNumbers random(9, 0, 0);
  DenseSymmetric K(std::vector<double>(static_cast<std::size_t>(n), 1.0));
  for (Index a = 0; a < n / 2; ++a)
    for (Index b = n / 2; b < n; ++b)
      K.add(a, b, {(1 + 0.2 * (random.next() - 0.5)) / (0.5 * static_cast<double>(n)), 0});
  EXPECT_TRUE(restore_closure(K, run).converged);
}

TEST(Closure, refuses_an_open_scene_and_leaves_it_as_it_was) {
  core::LocalRun run(1, 1);
  const OperatorPair pair = random_pair(100, 10, 2, true, true);
  for (Index b = 0; b < 100; ++b)
    if (b % 2 == 0) pair.K->add(3, b, {0, 0});  // half of what element 3 sees is sky
  const Eigen::MatrixXd before = full(*pair.K);
  try {
    restore_closure(*pair.K, run);
    FAIL() << "an InputError expected";
  } catch (const core::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("element 3 "), std::string::npos) << error.what();
    EXPECT_EQ(core::single_line(error.what()), error.what());
  }
  EXPECT_EQ(full(*pair.K), before);
}

TEST(Closure, refuses_a_correction_above_its_limit_and_leaves_K_as_it_was) {
  core::LocalRun run(1, 1);
  const OperatorPair pair = perturbed(100, 0.1, 11);
  EXPECT_THROW(restore_closure(*pair.K, run, {.largest_correction = 1e-4}), core::InputError);
  EXPECT_EQ(full(*pair.K), pair.full);
}

// Two elements of unequal area that see only each other cannot both have row sum 1.
TEST(Closure, says_so_where_no_scaling_exists) {
  core::LocalRun run(1, 1);
  DenseSymmetric K({1.0, 1.1});
  K.add(0, 1, {1.05, 0});
  EXPECT_THROW(restore_closure(K, run), core::InputError);
  EXPECT_EQ(K.entry(0, 1), 1.05);
}

TEST(Closure, gives_the_same_bits_for_any_number_of_threads) {
  Eigen::MatrixXd one;
  for (const unsigned threads : {1u, 2u, 3u, 8u}) {
    core::LocalRun run(1, threads);
    const OperatorPair pair = perturbed(700, 0.02, 12);
    restore_closure(*pair.K, run);
    if (threads == 1)
      one = full(*pair.K);
    else
      EXPECT_EQ(full(*pair.K), one) << threads;
  }
}

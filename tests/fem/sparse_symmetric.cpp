#include "fem/operator/sparse_symmetric.h"

#include <gtest/gtest.h>

#include "fem/assembly.h"
#include "fem/dropped_irradiance.h"
#include "solvers/solver.h"
#include "tests/fem/operator_fixtures.h"

using namespace interflect;
using namespace interflect::fem;

namespace {

/// Whether a threshold keeps a pair: F_ab or F_ba is not below it.
bool is_kept(const OperatorPair& pair, Index a, Index b, double threshold) {
  return pair.full(a, b) >= threshold * std::min(pair.areas(a), pair.areas(b)) &&
         (pair.full(a, b) > 0 || pair.errors(a, b) > 0);
}

/// A threshold that drops about half of the entries of `random_pair`, whose K_ab is A_a A_b u / sum A.
double middle_threshold(const OperatorPair& pair) { return pair.areas.mean() / pair.areas.sum(); }

}  // namespace

// Rounding of a sum of n products: n 2^-53 of the sum of their magnitudes, |K| |b|; and the strips' sums.
TEST(SparseSymmetric, multiplies_any_number_of_columns_as_a_full_matrix_does) {
  core::LocalRun run(1, 1);
  for (const Index n : {1, 2, 63, 64, 65, 130, 517}) {
    const OperatorPair pair = random_pair(n, 1);
    const auto K = sparse(pair, 0, run.get());
    for (const Index columns : {1, 3, 7}) {
      const solvers::ColumnMatrix b = random_columns(n, columns, 2);
      solvers::ColumnMatrix out = solvers::ColumnMatrix::Constant(n, columns, 7);
      K->apply(b, out, run);
      const Eigen::MatrixXd scale = pair.full * Eigen::MatrixXd(b.cwiseAbs()), exact = pair.full * Eigen::MatrixXd(b);
      EXPECT_TRUE(((out - exact).array().abs() <= 0x1p-53 * static_cast<double>(n + 20) * scale.array()).all())
          << n << " x " << columns;
    }
  }
}

TEST(SparseSymmetric, hands_out_entries_errors_and_any_block_of_rows) {
  core::LocalRun run(1, 1);
  const OperatorPair pair = random_pair(200, 4);
  const auto K = sparse(pair, 0, run.get());
  Index handed_out = 0;
  for (const auto& [first, count] :
       std::vector<std::pair<Index, Index>>{{0, 1}, {199, 1}, {60, 10}, {0, 200}, {64, 64}, {127, 66}}) {
    solvers::ColumnMatrix rows = solvers::ColumnMatrix::Constant(count, 200, -1);
    K->rows(first, count, rows);
    EXPECT_EQ(Eigen::MatrixXd(rows), pair.full.middleRows(first, count)) << first << " + " << count;
    handed_out += count;
    EXPECT_EQ(K->evaluated(), handed_out);
  }
  for (Index a = 0; a < 200; a += 7)
    for (Index b = 0; b < 200; ++b) {
      EXPECT_EQ(K->entry(a, b), pair.full(a, b));
      EXPECT_EQ(K->entry_standard_error(a, b), pair.errors(a, b));
    }
}

TEST(SparseSymmetric, hands_out_the_entries_of_a_row_that_it_has_in_their_order) {
  core::LocalRun run(1, 1);
  const Index n = 200;
  const OperatorPair pair = random_pair(n, 5, 4, true, true);
  const auto K = sparse(pair, middle_threshold(pair), run.get());
  std::vector<solvers::RowEntry> row;
  for (Index a = 0; a < n; ++a) {
    K->row(a, row);
    Index before = -1;
    Eigen::VectorXd found = Eigen::VectorXd::Zero(n);
    for (const solvers::RowEntry& entry : row) {
      EXPECT_GT(entry.unknown, before);
      before = entry.unknown;
      found(entry.unknown) = entry.K;
    }
    EXPECT_LT(std::ssize(row), n);
    for (Index b = 0; b < n; ++b) EXPECT_EQ(found(b), K->entry(a, b)) << a << ' ' << b;
  }
  EXPECT_EQ(K->evaluated(), n);
}

// The same entries, stored densely and sparsely: a scan of all unknowns and matches of those that changed take the same
// steps, so that what comes of them has the same bits.
TEST(SparseSymmetric, is_shot_from_in_the_steps_that_the_dense_one_is) {
  const Index n = 333;
  const OperatorPair pair = random_pair(n, 16, 4, true, true);
  const solvers::ColumnMatrix e = random_columns(n, 3, 15).cwiseAbs();
  const solvers::Reflection R(solvers::ColumnMatrix::Constant(n, 3, 0.9));
  core::LocalRun run(1, 2);
  const auto K = sparse(pair, middle_threshold(pair), run.get());
  std::vector<double> areas(pair.areas.data(), pair.areas.data() + n);
  DenseSymmetric dense(areas);
  for (Index a = 0; a < n; ++a)
    for (Index b = a; b < n; ++b) dense.add(a, b, {K->entry(a, b), 0});
  for (const char* name : {"southwell", "progressive"})
    for (const int steps : {1, 2, 50, 1000}) {
      solvers::SolverSettings settings;
      settings.steps = steps;
      solvers::SolverState of_dense, of_sparse;
      const auto of = solvers::make_solver(name, settings);
      EXPECT_EQ(of->advance({dense, R, e}, of_dense, {1e-12, 3}, run).history,
                of->advance({*K, R, e}, of_sparse, {1e-12, 3}, run).history);
      EXPECT_EQ(of_dense.x, of_sparse.x) << name << ' ' << steps;
      EXPECT_EQ(of_dense.residual, of_sparse.residual) << name << ' ' << steps;
    }
}

// Areas over four decades: the threshold is on the larger of both form factors, and what is dropped is counted for both
// rows.
TEST(SparseSymmetric, drops_what_is_below_in_both_directions_and_counts_it) {
  core::LocalRun run(1, 2);
  const Index n = 300;
  const OperatorPair pair = random_pair(n, 5, 4, true, true);
  const double threshold = middle_threshold(pair);
  const auto K = sparse(pair, threshold, run.get());
  Eigen::VectorXd dropped = Eigen::VectorXd::Zero(n);
  std::uint64_t kept = 0;
  for (Index a = 0; a < n; ++a)
    for (Index b = 0; b < n; ++b) {
      const bool keep = is_kept(pair, a, b, threshold);
      EXPECT_EQ(K->entry(a, b), keep ? pair.full(a, b) : 0.0);
      if (!keep) dropped(a) += pair.full(a, b) / pair.areas(a);
      kept += keep && a < b;
    }
  const double pairs = 0.5 * static_cast<double>(n * (n - 1));
  EXPECT_GT(kept, 0.1 * pairs);
  EXPECT_LT(kept, 0.9 * pairs);
  EXPECT_DOUBLE_EQ(K->kept_share(), static_cast<double>(kept) / pairs);
  EXPECT_LE(static_cast<double>(kept), static_cast<double>(n) / threshold) << "rows add up to 1";
  const std::vector<double> sums = K->row_sums(run);
  for (Index a = 0; a < n; ++a) {
    const auto row = static_cast<std::size_t>(a);
    EXPECT_GE(K->dropped()[row], dropped(a)) << "rounded up";
    EXPECT_LE(K->dropped()[row], dropped(a) + static_cast<double>(n) * 0x1p-52);
    EXPECT_NEAR(sums[row] + dropped(a), 1, 1e-12);
  }
}

TEST(SparseSymmetric, takes_twelve_bytes_a_kept_pair_and_four_more_for_an_error) {
  core::LocalRun run(1, 1);
  for (const bool exact : {true, false}) {
    const OperatorPair pair = random_pair(400, 6, 4, false, exact);
    const auto K = sparse(pair, 1e-3, run.get());
    const double kept = K->sum_over_entries(run.get(), [](Index a, Index b, double) { return a == b ? 1.0 : 0.5; });
    EXPECT_EQ(K->bytes(), (exact ? 12 : 16) * kept);
    EXPECT_EQ(K->has_errors(), !exact);
  }
}

TEST(SparseSymmetric, gives_the_same_bits_for_any_number_of_threads) {
  const Index n = 700;
  const OperatorPair pair = random_pair(n, 7);
  const double threshold = middle_threshold(pair);
  const solvers::ColumnMatrix b = random_columns(n, 3, 8);
  solvers::ColumnMatrix product(n, 3), variance(n, 3);
  core::LocalRun one(1, 1);
  const auto K = sparse(pair, threshold, one.get());
  K->apply(b, product, one);
  K->apply_variances(b.cwiseAbs2(), variance, one);
  for (const unsigned threads : {2u, 3u, 8u}) {
    core::LocalRun several(1, threads);
    const auto other = sparse(pair, threshold, several.get());
    solvers::ColumnMatrix out(n, 3);
    other->apply(b, out, several);
    EXPECT_EQ(out, product) << threads;
    other->apply_variances(b.cwiseAbs2(), out, several);
    EXPECT_EQ(out, variance) << threads;
    EXPECT_TRUE(std::equal(K->dropped().begin(), K->dropped().end(), other->dropped().begin())) << threads;
    EXPECT_EQ(full(*other), full(*K));
  }
}

TEST(SparseSymmetric, keeps_the_last_of_what_is_written_for_a_pair) {
  core::LocalRun run(1, 1);
  SparseAssembly assembly({1, 1, 1}, 0);
  assembly.add(0, 1, {0.25, 0.1});
  assembly.add(1, 2, {0.5, 0});
  assembly.add(1, 0, {0.75, 0});
  const auto K = assembly.packed(run.get());
  EXPECT_EQ(K->entry(0, 1), 0.75);
  EXPECT_EQ(K->entry_standard_error(0, 1), 0);
  EXPECT_EQ(K->entry(2, 1), 0.5);
  EXPECT_EQ(K->bytes(), 2 * 12);
}

// sum_b e_ab² b_b² over what is kept, and over what was dropped with the largest b².
TEST(SparseSymmetric, counts_the_noise_of_what_it_dropped) {
  core::LocalRun run(1, 1);
  const Index n = 140;
  const OperatorPair pair = random_pair(n, 9);
  const double threshold = middle_threshold(pair);
  const auto K = sparse(pair, threshold, run.get());
  const solvers::ColumnMatrix squares = random_columns(n, 2, 10).cwiseAbs2();
  solvers::ColumnMatrix out(n, 2);
  K->apply_variances(squares, out, run);
  for (Index a = 0; a < n; ++a)
    for (Index c = 0; c < 2; ++c) {
      double kept = 0, dropped = 0;
      for (Index b = 0; b < n; ++b)
        (is_kept(pair, a, b, threshold) ? kept : dropped) +=
            std::pow(pair.errors(a, b), 2) *
            (is_kept(pair, a, b, threshold) ? squares(b, c) : squares.col(c).maxCoeff());
      EXPECT_NEAR(out(a, c), kept + dropped, 1e-9 * (kept + dropped) + 1e-15 * pair.areas(a) * pair.areas(a));
      EXPECT_GE(out(a, c), (1 - 1e-12) * (kept + dropped));
    }
}

// K B of all entries less K B of those that are kept is what the dropped ones bring: at most the bound, and a bound
// worth having.
TEST(DroppedIrradiance, bounds_what_dropped_entries_bring) {
  core::LocalRun run(1, 2);
  const Index n = 300;
  const OperatorPair pair = random_pair(n, 11, 3, true, true);
  const auto K = sparse(pair, middle_threshold(pair), run.get());
  solvers::ColumnMatrix B = random_columns(n, 2, 12).cwiseAbs();
  for (Index a = 0; a < n; a += 50) B(a, 0) = 100;  // a few lamps
  solvers::ColumnMatrix all(n, 2), kept(n, 2);
  pair.K->apply(B, all, run);
  K->apply(B, kept, run);
  const solvers::ColumnMatrix bound = dropped_irradiance(*K, B, run.get());
  double mean = 0;
  for (Index c = 0; c < 2; ++c)
    for (Index a = 0; a < n; ++a) {
      EXPECT_LE((all(a, c) - kept(a, c)) / pair.areas(a), bound(a, c) + 1e-12 * bound.maxCoeff());
      EXPECT_LE(bound(a, c), (1 + 1e-12) * K->dropped()[static_cast<std::size_t>(a)] * B.col(c).maxCoeff());
    }
  for (Index a = 0; a < n; ++a) mean += K->dropped()[static_cast<std::size_t>(a)] * B.col(0).maxCoeff();
  EXPECT_LT(bound.col(0).sum(), 0.5 * mean) << "lamps are few";
  EXPECT_TRUE(dropped_irradiance(*pair.K, B, run.get()).isZero()) << "nothing is dropped by a dense operator";
}

TEST(SparseSymmetric, serves_both_solvers_as_the_dense_one_does) {
  const Index n = 333;
  const OperatorPair pair = random_pair(n, 14, 4, true);
  const solvers::ColumnMatrix e = random_columns(n, 3, 15).cwiseAbs();
  const solvers::Reflection R(solvers::ColumnMatrix::Constant(n, 3, 0.9));
  core::LocalRun run(1, 2);
  const auto K = sparse(pair, 0, run.get());
  for (const std::string& name : solvers::solver_names(false)) {
    solvers::SolverState of_dense, of_sparse;
    EXPECT_TRUE(solvers::make_solver(name)->advance({*pair.K, R, e}, of_dense, {1e-14, 10000}, run).converged())
        << name;
    EXPECT_TRUE(solvers::make_solver(name)->advance({*K, R, e}, of_sparse, {1e-14, 10000}, run).converged()) << name;
    EXPECT_LE((of_dense.x - of_sparse.x).cwiseAbs().maxCoeff(), 2e-13 * of_dense.x.maxCoeff())
        << name;  // 2 residuals / (1 - 0.9)
  }
}

TEST(SparseSymmetric, is_aggregated_as_the_dense_one_is) {
  core::LocalRun run(1, 2);
  const OperatorPair pair = random_pair(280, 16, 3, false, true);
  const auto K = sparse(pair, 0, run.get());
  const auto of_dense = aggregated(*pair.K, run), of_sparse = aggregated(*K, run);
  EXPECT_EQ(full(*of_dense), full(*of_sparse));
  EXPECT_NE(dynamic_cast<const SparseSymmetric*>(of_sparse.get()), nullptr);
  const double children = pair.full.block(8, 20, 4, 4).sum();
  EXPECT_NEAR(of_dense->entry(2, 5), children, 1e-14 * children);
}

TEST(SparseSymmetric, keeps_its_diagonal_for_solvers_and_changes_entries_in_place) {
  core::LocalRun run(1, 2);
  const OperatorPair pair = random_pair(150, 17, 4, false, true);
  const auto K = sparse(pair, 0, run.get());
  SparseAssembly assembly({2, 2}, 0);
  assembly.add(1, 1, {0.25, 0});
  const auto small = assembly.packed(run.get());
  EXPECT_EQ(small->self()[1], 0.25);
  small->change([](const StoredPair& p) { return 4 * p.K; }, run);
  EXPECT_EQ(small->self()[1], 1.0);
  K->change([](const StoredPair& p) { return 2 * p.K + (p.a + p.b == 149 ? 1 : 0); }, run);
  Eigen::MatrixXd expected = 2 * pair.full;
  for (Index a = 0; a < 150; ++a)
    if (pair.full(a, 149 - a) > 0) expected(a, 149 - a) += 1;
  EXPECT_EQ(full(*K), expected);
}

TEST(SparseSymmetric, without_elements_or_entries_is_empty) {
  core::LocalRun run;
  SparseAssembly none({}, 0.1), nothing(std::vector<double>(130, 1.0), 0.1);
  const auto K = none.packed(run.get());
  solvers::ColumnMatrix b(0, 3), out(0, 3);
  K->apply(b, out, run);
  K->apply_variances(b, out, run);
  EXPECT_EQ(K->size(), 0);
  const auto dark = nothing.packed(run.get());
  solvers::ColumnMatrix zero = solvers::ColumnMatrix::Constant(130, 2, 3);
  dark->apply(solvers::ColumnMatrix::Ones(130, 2), zero, run);
  EXPECT_TRUE(zero.isZero());
  EXPECT_EQ(dark->strips(), 1);
}

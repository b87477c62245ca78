#include <gtest/gtest.h>

#include "core/error.h"
#include "tests/fem/operator_fixtures.h"

using namespace interflect;
using namespace interflect::fem;

// Rounding of a sum of n products: n 2^-53 of the sum of their magnitudes, which is |K| |b|.
TEST(DenseSymmetric, multiplies_any_number_of_columns_as_a_full_matrix_does) {
  core::LocalRun run(1, 1);
  for (const Index n : {1, 2, 63, 64, 65, 130, 517}) {
    const OperatorPair pair = random_pair(n, 1);
    for (Index columns = 1; columns <= 16; ++columns) {
      const solvers::ColumnMatrix b = random_columns(n, columns, 2);
      solvers::ColumnMatrix out = solvers::ColumnMatrix::Constant(n, columns, 7);
      pair.K->apply(b, out, run);
      const solvers::ColumnMatrix exact = pair.full * b;
      const Eigen::MatrixXd magnitudes = b.cwiseAbs(), scale = pair.full * magnitudes;
      EXPECT_LE((out - exact).cwiseAbs().maxCoeff(), 1e-14 * scale.maxCoeff()) << n << " x " << columns;
      EXPECT_TRUE(((out - exact).array().abs() <= 0x1p-53 * static_cast<double>(n + 8) * scale.array()).all())
          << n << " x " << columns;
    }
  }
}

TEST(DenseSymmetric, is_symmetric_by_construction_whichever_way_a_pair_is_written) {
  core::RandomNumbers random(3, 0, 0);
  DenseSymmetric K(std::vector<double>(150, 1.0));
  Eigen::MatrixXd full = Eigen::MatrixXd::Zero(150, 150);
  for (Index a = 0; a < 150; ++a)
    for (Index b = a; b < 150; ++b) {
      const double u = random.next();
      random.next() < 0.5 ? K.add(a, b, {u, 0.1 * u}) : K.add(b, a, {u, 0.1 * u});
      full(a, b) = full(b, a) = u;
    }
  solvers::ColumnMatrix rows(150, 150);
  K.rows(0, 150, rows);
  EXPECT_EQ(Eigen::MatrixXd(rows), full);
  for (Index a = 0; a < 150; ++a)
    for (Index b = 0; b < 150; ++b) {
      EXPECT_EQ(K.entry(a, b), full(a, b));
      EXPECT_EQ(K.entry_standard_error(a, b), K.entry_standard_error(b, a));
      EXPECT_NEAR(K.entry_standard_error(a, b), 0.1 * full(a, b), 1e-7);
    }
}

TEST(DenseSymmetric, hands_out_any_block_of_rows_and_counts_them) {
  const OperatorPair pair = random_pair(200, 4);
  Index handed_out = 0;
  for (const auto& [first, count] :
       std::vector<std::pair<Index, Index>>{{0, 1}, {199, 1}, {60, 10}, {0, 200}, {64, 64}, {127, 66}}) {
    solvers::ColumnMatrix rows = solvers::ColumnMatrix::Constant(count, 200, -1);
    pair.K->rows(first, count, rows);
    EXPECT_EQ(Eigen::MatrixXd(rows), pair.full.middleRows(first, count)) << first << " + " << count;
    handed_out += count;
    EXPECT_EQ(pair.K->evaluated(), handed_out);
  }
}

TEST(DenseSymmetric, adds_up_form_factors_over_rows_of_areas_four_decades_apart) {
  core::LocalRun run(1, 2);
  const OperatorPair pair = random_pair(300, 5, 4, true);
  for (const double sum : pair.K->row_sums(run)) EXPECT_NEAR(sum, 1, 1e-13);
  EXPECT_EQ(pair.K->gram().size(), 300u);
  EXPECT_EQ(pair.K->gram()[17], pair.areas(17));
}

TEST(DenseSymmetric, knows_the_variances_of_its_product) {
  core::LocalRun run(1, 1);
  const OperatorPair pair = random_pair(140, 6);
  const solvers::ColumnMatrix b = random_columns(140, 3, 7);
  solvers::ColumnMatrix out(140, 3);
  pair.K->apply_variances(b.cwiseAbs2(), out, run);
  const Eigen::MatrixXd exact = pair.errors.cwiseAbs2() * Eigen::MatrixXd(b).cwiseAbs2();
  EXPECT_GT(exact.minCoeff(), 0);
  EXPECT_LE((out - exact).cwiseQuotient(exact).cwiseAbs().maxCoeff(), 1e-13);
}

// Two products with the same realised errors: the spread of 4000 products is what `apply_variances` says.  A sample
// variance of m normal-like numbers has a relative standard deviation of sqrt(2 / m) = 2.2 % (less for uniform ones); 5
// of these.
TEST(DenseSymmetric, has_the_variance_that_independent_errors_make) {
  core::LocalRun run(1, 1);
  const Index n = 40, trials = 4000;
  const OperatorPair pair = random_pair(n, 8, 2);
  const solvers::ColumnMatrix b = solvers::ColumnMatrix::Ones(n, 1);
  solvers::ColumnMatrix predicted(n, 1);
  pair.K->apply_variances(b, predicted, run);  // of ones: the squares are ones too
  Eigen::ArrayXd sum = Eigen::ArrayXd::Zero(n), squares = sum;
  for (Index t = 0; t < trials; ++t) {
    core::RandomNumbers random(9, 0, static_cast<std::uint64_t>(t));
    Eigen::ArrayXd deviation = Eigen::ArrayXd::Zero(n);
    for (Index i = 0; i < n; ++i)
      for (Index j = i; j < n; ++j) {
        const double error = pair.errors(i, j) * std::sqrt(12.0) * (random.next() - 0.5);
        deviation(i) += error;
        if (i != j) deviation(j) += error;
      }
    sum += deviation;
    squares += deviation.square();
  }
  const Eigen::ArrayXd variance = squares / trials - (sum / trials).square();
  EXPECT_LE((variance / predicted.col(0).array() - 1).abs().maxCoeff(), 5 * std::sqrt(2.0 / trials));
}

TEST(DenseSymmetric, stores_each_pair_once) {
  for (const Index n : {1000, 3000}) {
    DenseSymmetric K(std::vector<double>(static_cast<std::size_t>(n), 1.0));
    const double pairs = 4.0 * static_cast<double>(n) * static_cast<double>(n);
    EXPECT_GE(K.bytes(), pairs);
    // What the last tiles and those on the diagonal hold too much: a tile more a row and column.
    EXPECT_LE(K.bytes(), pairs * std::pow(1 + 2.0 * solvers::tile_size / static_cast<double>(n), 2));
    EXPECT_FALSE(K.has_errors());
    const double before = K.bytes();
    K.add(0, n - 1, {1, 0.5});
    EXPECT_TRUE(K.has_errors());
    EXPECT_EQ(K.bytes(), before + 4.0 * solvers::tile_size * solvers::tile_size) << "errors of one tile";
  }
}

TEST(DenseSymmetric, forgets_an_error_that_is_overwritten) {
  DenseSymmetric K({1, 1});
  K.add(0, 1, {2, 0.5});
  K.add(1, 0, {3, 0});
  EXPECT_EQ(K.entry(0, 1), 3);
  EXPECT_EQ(K.entry_standard_error(0, 1), 0);
}

TEST(DenseSymmetric, keeps_its_diagonal_for_solvers) {
  DenseSymmetric K(std::vector<double>(70, 2.0));
  K.add(66, 66, {0.25, 0});
  EXPECT_EQ(K.self()[66], 0.25);
  EXPECT_EQ(K.self()[65], 0);
  core::LocalRun run;
  K.change([](const StoredPair& pair) { return 4 * pair.K; }, run);
  EXPECT_EQ(K.self()[66], 1.0);
}

TEST(DenseSymmetric, sums_over_both_triangles) {
  core::LocalRun run(1, 2);
  const OperatorPair pair = random_pair(150, 10);
  const double squares = pair.K->sum_over_entries(run, [](Index, Index, double K_ab) { return K_ab * K_ab; });
  EXPECT_NEAR(squares, pair.full.squaredNorm(), 1e-12 * squares);
}

TEST(DenseSymmetric, without_elements_is_empty) {
  core::LocalRun run;
  const DenseSymmetric K({});
  solvers::ColumnMatrix b(0, 3), out(0, 3);
  K.apply(b, out, run);
  EXPECT_EQ(K.size(), 0);
}

TEST(DenseSymmetric, says_in_one_line_how_much_memory_was_missing) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer ends a program that asks for so much";
#endif
  try {
    DenseSymmetric K(std::vector<double>(20'000'000, 1.0));  // 1.6 PB
    FAIL() << "an InputError expected";
  } catch (const core::InputError& error) {
    EXPECT_EQ(core::single_line(error.what()), error.what());
    EXPECT_NE(std::string(error.what()).find('B'), std::string::npos);
  }
}

#include <gtest/gtest.h>

#include "solvers/gauss_seidel.h"
#include "tests/solvers/random_systems.h"

using namespace interflect;
using namespace interflect::solvers;

namespace {

struct Method {
  double relaxation;
  GaussSeidel::Sweep sweep;
};
constexpr Method methods[] = {
    {1, GaussSeidel::Sweep::forward}, {1.3, GaussSeidel::Sweep::forward}, {1, GaussSeidel::Sweep::back_and_forth}};

SolverReport sweeps(const Method& method, const System& system, ColumnMatrix& x, int count, unsigned threads = 1) {
  core::LocalRun run(1, threads);
  SolverState state{x};
  SolverReport report = GaussSeidel(method.relaxation, method.sweep)
                            .advance(system, state, {.tolerance = 0, .max_iterations = count}, run);
  x = state.x;
  return report;
}

/// One sweep over rows in the order given, as its definition says.
void sweep_by_definition(const FullOperator& K, const ColumnMatrix& rho, const ColumnMatrix& e, double relaxation,
                         bool ascending, ColumnMatrix& x) {
  const Index n = x.rows();
  for (Index k = 0; k < n; ++k) {
    const Index a = ascending ? k : n - 1 - k;
    for (Index c = 0; c < x.cols(); ++c) {
      const double reflected = rho(a, c) / K.gram()[static_cast<std::size_t>(a)], K_aa = K.matrix()(a, a);
      const double of_others = K.matrix().row(a).dot(x.col(c)) - K_aa * x(a, c);
      x(a, c) += relaxation * ((e(a, c) + reflected * of_others) / (1 - reflected * K_aa) - x(a, c));
    }
  }
}

}  // namespace

// After a few sweeps, far from convergence: the very iterates agree, to the rounding of sums of n terms.
TEST(Sweeps, are_what_their_definition_says_row_by_row_from_rows_and_from_tiles) {
  for (const Index n : {1, 63, 64, 65, 200})
    for (const Index columns : {1, 3, 5})
      for (const Method& method : methods) {
        const FullOperator K = random_operator(n, 7 + static_cast<std::uint64_t>(n));
        const TiledOperator tiled(K);
        const ColumnMatrix rho = random_columns(n, columns, 0, 0.95, 41), e = random_columns(n, columns, 0, 1, 42);
        ColumnMatrix expected = e, from_rows = e, from_tiles = e;
        for (int k = 0; k < 3; ++k) {
          if (method.sweep == GaussSeidel::Sweep::back_and_forth)
            sweep_by_definition(K, rho, e, method.relaxation, false, expected);
          sweep_by_definition(K, rho, e, method.relaxation, true, expected);
        }
        const SolverReport of_rows = sweeps(method, {K, Reflection(rho), e}, from_rows, 3);
        const SolverReport of_tiles = sweeps(method, {tiled, Reflection(rho), e}, from_tiles, 3);
        const double rounding = 1e-14 * expected.maxCoeff();
        EXPECT_LE((from_rows - expected).cwiseAbs().maxCoeff(), rounding) << n << ' ' << columns;
        EXPECT_LE((from_tiles - expected).cwiseAbs().maxCoeff(), rounding) << n << ' ' << columns;
        for (std::size_t k = 0; k < of_rows.history.size(); ++k)
          EXPECT_NEAR(of_rows.history[k].residual, of_tiles.history[k].residual, 1e-14);
      }
}

TEST(Sweeps, from_tiles_say_the_residual_of_the_very_result) {
  const Index n = 150;
  const FullOperator K = random_operator(n, 43);
  const TiledOperator tiled(K);
  const ColumnMatrix rho = random_columns(n, 3, 0, 0.95, 44), e = random_columns(n, 3, 0, 1, 45);
  const Eigen::Map<const Eigen::VectorXd> G(K.gram().data(), n);
  for (const Method& method : methods)
    for (const int count : {1, 2, 7}) {
      ColumnMatrix x = e;
      const double said = sweeps(method, {tiled, Reflection(rho), e}, x, count).residual();
      const ColumnMatrix h = (K.matrix() * x).array().colwise() / G.array();
      const ColumnMatrix r = e + ColumnMatrix(rho.array() * h.array()) - x;
      double expected = 0;
      for (Index c = 0; c < 3; ++c)
        expected = std::max(expected, r.col(c).cwiseAbs().maxCoeff() / x.col(c).cwiseAbs().maxCoeff());
      EXPECT_NEAR(said, expected, 1e-14);
    }
}

// Threads share pieces of sums, and make new values beside the passes: no sum is added in another order.  A solve that is
// gone on with has to send all that it has once more.
TEST(Sweeps, from_tiles_have_the_same_bits_for_any_number_of_threads_and_when_they_are_gone_on_with) {
  const Index n = 64 * 50 + 7;  // four pieces
  core::RandomNumbers random(46, 0, 0);
  Eigen::MatrixXd matrix(n, n);
  for (Index a = 0; a < n; ++a)
    for (Index b = 0; b <= a; ++b) matrix(a, b) = matrix(b, a) = random.next() / static_cast<double>(n);
  const FullOperator K(matrix, Eigen::VectorXd::Ones(n));
  const TiledOperator tiled(K);
  const ColumnMatrix rho = random_columns(n, 2, 0, 0.9, 47), e = random_columns(n, 2, 0, 1, 48);
  const Reflection R(rho);
  const System system{tiled, R, e};
  for (const Method& method : methods) {
    ColumnMatrix one = e;
    const SolverReport report = sweeps(method, system, one, 4);
    for (const unsigned threads : {2u, 3u, 8u}) {
      ColumnMatrix several = e;
      EXPECT_EQ(sweeps(method, system, several, 4, threads).history, report.history);
      EXPECT_EQ(one, several) << threads;
    }
    ColumnMatrix in_two = e;
    sweeps(method, system, in_two, 1);
    sweeps(method, system, in_two, 3);
    EXPECT_EQ(one, in_two);
  }
}

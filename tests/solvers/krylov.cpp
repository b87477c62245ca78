#include <gtest/gtest.h>

#include "core/error.h"
#include "solvers/conjugate_gradients.h"
#include "solvers/gmres.h"
#include "solvers/system_check.h"
#include "tests/solvers/random_systems.h"

namespace interflect::solvers {
namespace {

SolverReport advance(const RadiositySolver& solver, const System& system, ColumnMatrix& x,
                     const StoppingRule& rule = {1e-14, 1000}) {
  core::LocalRun run(1, 1);
  SolverState state{x};
  const SolverReport report = solver.advance(system, state, rule, run);
  x = state.x;
  return report;
}

/// R of three unknowns an element with eigenvalues between 0 and .95, some of them 0.
Reflection random_blocks(Index elements, Index channels, std::uint64_t seed) {
  core::RandomNumbers random(seed, 2, 0);
  std::vector<Reflection::Block> blocks;
  for (Index i = 0; i < elements; ++i) {
    Reflection::Block block{3 * i, {}};
    for (Index c = 0; c < channels; ++c) {
      Eigen::Matrix3d any;
      for (double& entry : any.reshaped()) entry = random.next() - .5;
      const Eigen::Matrix3d Q = Eigen::HouseholderQR<Eigen::Matrix3d>(any).householderQ();
      const Eigen::Vector3d rho(.95 * random.next(), .95 * random.next(), i % 4 == 0 ? 0 : .95 * random.next());
      block.of_channel.push_back(Q * rho.asDiagonal() * Q.transpose());
    }
    blocks.push_back(std::move(block));
  }
  return {ColumnMatrix::Zero(3 * elements, channels), std::move(blocks)};
}

ColumnMatrix by_elimination(const FullOperator& op, const Reflection& R, const ColumnMatrix& e) {
  const Index n = e.rows();
  const Eigen::Map<const Eigen::VectorXd> G(op.gram().data(), n);
  ColumnMatrix b(n, e.cols());
  for (Index c = 0; c < e.cols(); ++c) {
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n, n);
    for (const Reflection::Block& block : R.blocks())
      dense.block<3, 3>(block.first, block.first) = block.of_channel[static_cast<std::size_t>(c)];
    const Eigen::MatrixXd A = Eigen::MatrixXd::Identity(n, n) - dense * G.cwiseInverse().asDiagonal() * op.matrix();
    b.col(c) = A.partialPivLu().solve(e.col(c));
  }
  return b;
}

// Areas of an element's functions are one, as in all spaces; row sums at most 1.
FullOperator in_threes(Index elements, std::uint64_t seed) {
  FullOperator K = random_operator(3 * elements, seed);
  Eigen::VectorXd areas(3 * elements);
  for (Index a = 0; a < areas.size(); ++a) areas(a) = K.gram()[static_cast<std::size_t>(a / 3 * 3)];
  Eigen::MatrixXd matrix = K.matrix();
  for (int round = 0; round < 30; ++round) {
    const Eigen::VectorXd s = (areas.array() / matrix.rowwise().sum().array()).sqrt();
    matrix = s.asDiagonal() * matrix * s.asDiagonal();
  }
  matrix /= (matrix.rowwise().sum().array() / areas.array()).maxCoeff();
  return {std::move(matrix), std::move(areas)};
}

TEST(Krylov, solves_with_reflectance_that_varies_inside_elements) {
  const Index elements = 30;
  const FullOperator K = in_threes(elements, 51);
  const Reflection R = random_blocks(elements, 2, 52);
  const ColumnMatrix e = random_columns(3 * elements, 2, 0, 1, 53), exact = by_elimination(K, R, e);
  for (const char* name : {"conjugate-gradients", "gmres", "automatic", "jacobi"}) {
    ColumnMatrix x = e;
    EXPECT_TRUE(advance(*make_solver(name), {K, R, e}, x, {1e-14, 2000}).converged()) << name;
    EXPECT_LE((x - exact).cwiseAbs().maxCoeff(), 1e-12 * exact.cwiseAbs().maxCoeff()) << name;
  }
}

TEST(Krylov, solves_where_K_is_not_symmetric) {
  const Index n = 120;
  const FullOperator symmetric = random_operator(n, 54);
  Eigen::MatrixXd matrix = symmetric.matrix();
  core::RandomNumbers random(55, 0, 0);
  for (double& entry : matrix.reshaped()) entry *= .3 + .7 * random.next();
  FullOperator K(matrix, Eigen::Map<const Eigen::VectorXd>(symmetric.gram().data(), n));
  K.says_symmetric = false;
  const ColumnMatrix rho = random_columns(n, 2, .5, .99, 56), e = random_columns(n, 2, 0, 1, 57);
  const Reflection R(rho);
  const ColumnMatrix exact = solvers::by_elimination(K, rho, e);
  for (const int restart : {3, 40}) {
    ColumnMatrix x = e;
    EXPECT_TRUE(advance(Gmres(restart), {K, R, e}, x).converged());
    EXPECT_LE((x - exact).cwiseAbs().maxCoeff(), 1e-12 * exact.maxCoeff()) << restart;
  }
  ColumnMatrix x = e;
  EXPECT_TRUE(advance(*make_solver("automatic"), {K, R, e}, x).converged());
  EXPECT_THROW(advance(ConjugateGradients(), {K, R, e}, x), core::InputError);
}

// Exact arithmetic would end after as many iterations as there are unknowns.
TEST(Krylov, ends_after_as_many_iterations_as_there_are_unknowns) {
  const FullOperator K = random_operator(8, 58);
  const ColumnMatrix rho = random_columns(8, 2, .5, .999, 59), e = random_columns(8, 2, 0, 1, 60);
  for (const char* name : {"conjugate-gradients", "gmres"}) {
    ColumnMatrix x = e;
    const SolverReport report = advance(*make_solver(name), {K, Reflection(rho), e}, x, {1e-12, 1000});
    EXPECT_TRUE(report.converged());
    EXPECT_LE(report.iterations(), 9) << name;
  }
}

TEST(Krylov, needs_few_iterations_where_nearly_nothing_is_absorbed) {
  const FullOperator open = random_operator(300, 61, true);
  const FullOperator K(open.matrix(), open.matrix().rowwise().sum());
  const ColumnMatrix rho = ColumnMatrix::Constant(300, 1, 1 - 1e-6), e = random_columns(300, 1, 0, 1, 62);
  ColumnMatrix x = e;
  const SolverReport report = advance(ConjugateGradients(), {K, Reflection(rho), e}, x, {1e-13, 200});
  EXPECT_TRUE(report.converged());
  EXPECT_LE(report.iterations(), 40);
  const Eigen::Map<const Eigen::VectorXd> G(K.gram().data(), 300);
  EXPECT_NEAR(1e-6 * G.dot(x.col(0)), G.dot(e.col(0)), 1e-6 * G.dot(e.col(0)));  // absorbed: emitted
}

}  // namespace
}  // namespace interflect::solvers

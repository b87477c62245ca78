#include <gtest/gtest.h>

#include "tests/solvers/six_faces.h"

// Every solver that is known, against what spheres have in closed form.
namespace interflect::solvers {
namespace {

/// Areas over four powers of ten, which add up to `all`.
Eigen::VectorXd unequal_areas(Index n, double all, std::uint64_t seed) {
  core::RandomNumbers random(seed, 2, 0);
  Eigen::VectorXd areas(n);
  for (Index a = 0; a < n; ++a) areas(a) = std::pow(10.0, 4 * random.next());
  return areas * (all / areas.sum());
}

struct Case {
  std::string name;
  FullOperator K;
  ColumnMatrix rho, e, B;
};

/// Inside of a sphere F_ij = A_j / A, so that all elements receive the same: h = sum A e / sum A (1 - rho).
Case sphere(double scale) {
  const Index n = 9;
  const Eigen::VectorXd A = unequal_areas(n, 3 * scale, 5);
  const ColumnMatrix rho = random_columns(n, 2, .1, .8, 6), e = random_columns(n, 2, 0, 2, 7);
  ColumnMatrix B = e;
  for (Index c = 0; c < 2; ++c) B.col(c) += A.dot(e.col(c)) / (A.array() * (1 - rho.col(c).array())).sum() * rho.col(c);
  return {"sphere", FullOperator(A * A.transpose() / A.sum(), A), rho, e, B};
}

/// The furnace: what all emit and reflect alike leaves e / (1 - rho) everywhere.
Case furnace(double scale) {
  const Index n = 7;
  const Eigen::VectorXd A = unequal_areas(n, scale, 8);
  const ColumnMatrix one = ColumnMatrix::Ones(n, 1);
  return {"furnace", FullOperator(A * A.transpose() / A.sum(), A), .7 * one, 2 * one, 2 / .3 * one};
}

/// A sphere in another, with a = A_1 / A_2: F_12 = 1, F_21 = a, F_22 = 1 - a, shared by area; each of one reflectance,
/// with emissions that differ.  h_1 = b_2 and h_2 = a b_1 + (1 - a) b_2 of the means b_1, b_2.
Case concentric(double scale) {
  const Index n1 = 4, n2 = 6;
  const double A1 = scale, A2 = 3 * scale, a = A1 / A2, rho1 = .3, rho2 = .6;
  Eigen::VectorXd A(n1 + n2);
  A << unequal_areas(n1, A1, 9), unequal_areas(n2, A2, 10);
  Eigen::MatrixXd K = A * A.transpose() / A2;
  K.topLeftCorner(n1, n1).setZero();
  K.bottomRightCorner(n2, n2) *= 1 - a;
  ColumnMatrix rho(n1 + n2, 1), e = random_columns(n1 + n2, 1, 0, 1, 11);
  rho.topRows(n1).setConstant(rho1);
  rho.bottomRows(n2).setConstant(rho2);
  const double e1 = A.head(n1).dot(e.col(0).head(n1)) / A1, e2 = A.tail(n2).dot(e.col(0).tail(n2)) / A2;
  const double b2 = (e2 + rho2 * a * e1) / (1 - rho2 * (1 - a) - rho2 * a * rho1), b1 = e1 + rho1 * b2;
  ColumnMatrix B = e;
  B.topRows(n1).array() += rho1 * b2;
  B.bottomRows(n2).array() += rho2 * (a * b1 + (1 - a) * b2);
  return {"concentric spheres", FullOperator(K, A), rho, e, B};
}

TEST(ClosedForms, are_what_every_solver_finds) {
  for (const double scale : {1e-6, 1.0, 1e6})
    for (const Case& of : {sphere(scale), furnace(scale), concentric(scale)})
      for (const SolverEntry& solver : known_solvers()) {
        core::LocalRun run(12, 2);
        const MatrixSampler walks(of.K);
        const Reflection R(of.rho);
        SolverState state{of.e};
        StoppingRule rule;
        rule.tolerance = 1e-14;
        rule.noise = 0.02;
        const std::vector<double> all(static_cast<std::size_t>(of.e.rows()), 1);
        const bool asks = solver.needs == SolverEntry::Needs::target;
        const System system{of.K, R, of.e, &walks, asks ? all : std::span<const double>()};
        const SolverReport report = solver.make({})->advance(system, state, rule, run);
        ASSERT_TRUE(report.converged()) << of.name << " " << solver.name;
        for (Index i = 0; i < of.B.rows(); ++i)
          for (Index c = 0; c < of.B.cols(); ++c) {
            const double exact = of.B(i, c), off = std::abs(state.x(i, c) - exact);
            if (solver.samples()) {
              // Student's t of 31 degrees of freedom; and the smallest of the elements, which few walks find.
              if (of.K.gram()[std::size_t(i)] < 1e-2 * of.K.matrix().sum()) continue;
              EXPECT_LT(off, 5 * state.standard_error(i, c)) << of.name << " " << solver.name << " " << i;
            } else {
              EXPECT_LT(off, 1e-12 * exact) << of.name << " " << solver.name << " " << i;
            }
          }
      }
}

}  // namespace
}  // namespace interflect::solvers

#pragma once

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <utility>

#include "solvers/solver.h"
#include "tests/fem/space/manufactured.h"

/// How near a manufactured solution comes back.
namespace interflect::fem::test {

inline ColumnMatrix solved(const SymmetricOperator& K, const ColumnMatrix& rho, const ColumnMatrix& e, Run& run) {
  solvers::SolverState state{e, 0};
  const solvers::Reflection R(rho);
  EXPECT_TRUE(solvers::make_solver("gauss-seidel")->advance({K, R, e}, state, {1e-14, 1000}, run).converged());
  return state.x;
}

/// (I - R G^-1 K)^-1 R
inline Eigen::MatrixXd reflected_resolvent(const SymmetricOperator& K, const ColumnMatrix& rho) {
  Eigen::MatrixXd system = Eigen::MatrixXd::Identity(K.size(), K.size());
  for (Index a = 0; a < K.size(); ++a)
    for (Index b = 0; b < K.size(); ++b) system(a, b) -= rho(a, 0) / K.gram()[std::size_t(a)] * K.entry(a, b);
  return system.inverse() * rho.col(0).asDiagonal();
}

struct Returned {
  double error = 0;                     ///< largest |b - b*| of the unknowns, over the largest |b*|
  double of_entries = 0, of_loads = 0;  ///< what each may add to it
};

/// b - b* = (I - R G^-1 K)^-1 R [G^-1 (K - K*) b* + (load - load*)] in any solution, so that
///
///   |b - b*| <= || (I - R G^-1 K)^-1 R || (max_i 1/A_i sum_j |K - K*|_ij max_b + load's error),    max norms
///
/// max_b being an element's largest sum of |coefficients|.  An entry may be off by the tolerance times the pair's
/// unoccluded K_00, and so may what is hidden of it, whose irradiance is off by a tenth of that with polynomials
/// (analytic_moments.h); or, of what is hidden, by the tolerance times A_i / (16 elements) (hidden_pairs.h):
///
///   1/A_i sum_j |K - K*|_ij <= tolerance (2.1 sum_j F_ij,unoccluded + 1/16)
inline Returned returned(const Manufactured& m, int order, double tolerance, double first_entry = 1) {
  RadiositySettings settings;
  settings.form_factors = "analytic";
  settings.order = order;
  settings.quadrature_tolerance = tolerance;
  core::LocalRun run(1, 1);
  RadiosityOperator all = m.assembled(settings, run.get());
  SymmetricOperator& K = order > 0 ? *all.blocks : *all.K;
  if (first_entry != 1) {
    bool found = false;
    K.change([&](const StoredPair& p) { return !std::exchange(found, true) ? first_entry * p.K : p.K; }, run.get());
  }
  const ColumnMatrix rho = m.reflectance(order), wanted = m.of_order(order, m.wanted);
  const ColumnMatrix b = solved(K, rho, m.exitance(order), run.get());
  const double resolvent = reflected_resolvent(K, rho).cwiseAbs().rowwise().sum().maxCoeff();
  const std::vector<double> F = unoccluded_row_sums(m.patches, 1e-6);
  const double row = tolerance * (2.1 * *std::max_element(F.begin(), F.end()) + 1.0 / 16), size = largest(wanted);
  double most = 0;
  const Index f = plane_functions(order);
  for (Index i = 0; i < std::ssize(m.patches); ++i)
    most = std::max(most, wanted.middleRows(i * f, f).cwiseAbs().colwise().sum().maxCoeff());
  return {largest(b - wanted) / size, resolvent * row * most / size, resolvent * m.load_error / size};
}

/// And by far: most entries are nearer than their tolerance, and their errors cancel.  A tenth of it in the worst of 56
/// random rooms.
inline void expect_near(const Returned& r, double tolerance, int order) {
  EXPECT_LT(r.error, r.of_entries + r.of_loads) << "order " << order << ", tolerance " << tolerance;
  EXPECT_LT(r.error, tolerance / 5 + r.of_loads) << "order " << order << ", tolerance " << tolerance;
}
}  // namespace interflect::fem::test

#pragma once

#include <Eigen/LU>

#include "fem/galerkin.h"
#include "fem/space/space.h"
#include "tests/fem/rooms.h"

/// Flatland by Galerkin's method, solved directly.
namespace interflect::fem::test {

/// Coefficients of B = E + rho H, with one reflectance for all.
inline Eigen::VectorXd solved_in_flatland(const Space& space, double rho, const Space::Field& exitance,
                                          int points_a_side) {
  LastEntrySink sink(space.gram().size());
  core::LocalRun run(1, 2);
  galerkin(space, FlatlandKernel(), SegmentPairRule(points_a_side), sink, run.get());
  const Eigen::Map<const Eigen::VectorXd> G(space.gram().data(), sink.K.rows());
  const Eigen::MatrixXd A =
      Eigen::MatrixXd::Identity(sink.K.rows(), sink.K.rows()) - rho * (G.cwiseInverse().asDiagonal() * sink.K).eval();
  return A.partialPivLu().solve(space.project(exitance, space.order() + 1));
}

}  // namespace interflect::fem::test

#include "fem/continuous.h"

#include <Eigen/SparseCholesky>
#include <algorithm>

#include "core/error.h"

namespace interflect::fem {
namespace {

using solvers::ColumnMatrix;

/// K P, some columns of it at a time: all columns of a call are one pass over K.
ColumnMatrix applied(const SymmetricOperator& K, const NodeSet::Prolongation& P, Run& run) {
  constexpr Index columns_at_once = 64;
  ColumnMatrix out(P.rows(), P.cols());
  for (Index first = 0; first < P.cols(); first += columns_at_once) {
    const Index count = std::min(columns_at_once, P.cols() - first);
    run.throw_if_stopped("continuous elements");
    ColumnMatrix some = ColumnMatrix::Zero(P.rows(), count), product(P.rows(), count);
    for (Index a = 0; a < P.rows(); ++a)
      for (NodeSet::Prolongation::InnerIterator entry(P, a); entry; ++entry)
        if (entry.col() >= first && entry.col() < first + count) some(a, entry.col() - first) = entry.value();
    K.apply(some, product, run);
    out.middleCols(first, count) = product;
  }
  return out;
}

}  // namespace

NodeOperator continuous_galerkin(const SymmetricOperator& K, const NodeSet& nodes, Run& run) {
  if (nodes.P.rows() != K.size()) throw core::PreconditionError("continuous_galerkin: K is of another space");
  const Eigen::Map<const Eigen::VectorXd> G(K.gram().data(), K.size());
  const Eigen::SparseMatrix<double> P = nodes.P, M = P.transpose() * G.asDiagonal() * P;
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(M);
  constexpr double dependent = 1e-12;  // of the largest pivot: rounding leaves less than nothing, or hardly more
  if (factors.info() != Eigen::Success || !(factors.vectorD().minCoeff() > dependent * factors.vectorD().maxCoeff()))
    throw core::PreconditionError("continuous_galerkin: corners' functions depend on each other: quads need order 2");
  const Eigen::MatrixXd KP = applied(K, nodes.P, run);
  return NodeOperator(ColumnMatrix(factors.solve(P.transpose() * KP)));
}

}  // namespace interflect::fem

#pragma once

#include <Eigen/LU>

#include "core/random.h"
#include "solvers/solver.h"
#include "solvers/tile_access.h"

namespace interflect::solvers {

/// A full matrix as an operator, with rows or without, symmetric or said not to be: the plainest one there is.
class FullOperator final : public TransportOperator, public RowAccess {
 public:
  FullOperator(Eigen::MatrixXd K, Eigen::VectorXd areas)
      : K_(std::move(K)), areas_(std::move(areas)), self_(K_.diagonal()), layout_(Layout::uniform(K_.rows(), 1)) {}

  bool with_rows = true, says_symmetric = true;
  mutable int applied = 0;

  const Eigen::MatrixXd& matrix() const { return K_; }
  const Layout& layout() const override { return layout_; }
  bool symmetric() const override { return says_symmetric; }
  void apply(ConstColumns b, Columns out, Run&) const override {
    ++applied;
    out = K_ * b;
  }
  std::span<const double> gram() const override { return {areas_.data(), static_cast<std::size_t>(areas_.size())}; }
  std::span<const double> self() const override { return {self_.data(), static_cast<std::size_t>(self_.size())}; }
  const RowAccess* rows() const override { return with_rows ? this : nullptr; }
  void rows(Index first, Index count, Columns out) const override { out = K_.middleRows(first, count); }
  Index evaluated() const override { return 0; }

 private:
  Eigen::MatrixXd K_;
  Eigen::VectorXd areas_, self_;
  Layout layout_;
};

/// The same, stored in tiles too.
class TiledOperator final : public TransportOperator, public TileAccess {
 public:
  explicit TiledOperator(const FullOperator& full)
      : full_(full), tile_rows_((full.matrix().rows() + tile_size - 1) / tile_size) {
    const Index n = tile_rows_ * tile_size;
    Eigen::MatrixXd padded = Eigen::MatrixXd::Zero(n, n);
    padded.topLeftCorner(full.matrix().rows(), full.matrix().rows()) = full.matrix();
    for (Index first = 0; first < n; first += part_rows)
      for (Index J = 0; J <= first / tile_size; ++J) append(padded.block(first, J * tile_size, part_rows, tile_size));
    append(ColumnMatrix::Zero(part_rows, tile_size));  // what lies behind the last is fetched too
  }
  const Layout& layout() const override { return full_.layout(); }
  bool symmetric() const override { return true; }
  void apply(ConstColumns b, Columns out, Run& run) const override { full_.apply(b, out, run); }
  std::span<const double> gram() const override { return full_.gram(); }
  std::span<const double> self() const override { return full_.self(); }
  const RowAccess* rows() const override { return full_.rows(); }
  const TileAccess* tiles() const override { return this; }
  const double* part(Index I, Index row, Index J) const override {
    const Index before = I * (I + 1) / 2 * (tile_size / part_rows) + row / part_rows * (I + 1) + J;
    return entries_.data() + before * part_entries;
  }

 private:
  void append(const ColumnMatrix& part) { entries_.insert(entries_.end(), part.data(), part.data() + part.size()); }

  const FullOperator& full_;
  Index tile_rows_;
  std::vector<double> entries_;
};

/// A random symmetric K with areas over four powers of ten, row sums sum_b K_ab <= A_a, zeros, and a diagonal unless
/// `planar`.
inline FullOperator random_operator(Index n, std::uint64_t seed, bool planar = false) {
  core::RandomNumbers random(seed, 0, 0);
  Eigen::VectorXd areas(n);
  for (Index a = 0; a < n; ++a) areas(a) = std::pow(10.0, 4 * random.next() - 2);
  Eigen::MatrixXd K(n, n);
  for (Index a = 0; a < n; ++a)
    for (Index b = a; b < n; ++b) {
      const double u = random.next();
      K(a, b) = K(b, a) = u < 0.3 || (planar && a == b) ? 0.0 : u * areas(a) * areas(b) / areas.sum();
    }
  // S K S with S below 1 keeps K symmetric; a few rounds bring every row sum near its area, and the last step below.
  for (int round = 0; round < 20; ++round) {
    const Eigen::VectorXd s = (areas.array() / K.rowwise().sum().array()).sqrt();
    K = s.asDiagonal() * K * s.asDiagonal();
  }
  K /= (K.rowwise().sum().array() / areas.array()).maxCoeff();
  return {std::move(K), std::move(areas)};
}

/// (I - R G^-1 K)^-1 e by LU, column by column.
inline ColumnMatrix by_elimination(const FullOperator& op, const ColumnMatrix& rho, const ColumnMatrix& e) {
  const Index n = op.matrix().rows();
  const Eigen::Map<const Eigen::VectorXd> G(op.gram().data(), n);
  ColumnMatrix b(n, e.cols());
  for (Index c = 0; c < e.cols(); ++c) {
    const Eigen::VectorXd scale = rho.col(c).cwiseQuotient(G);
    b.col(c) = (Eigen::MatrixXd::Identity(n, n) - scale.asDiagonal() * op.matrix()).partialPivLu().solve(e.col(c));
  }
  return b;
}

inline ColumnMatrix random_columns(Index n, Index columns, double low, double high, std::uint64_t seed) {
  core::RandomNumbers random(seed, 1, 0);
  ColumnMatrix m(n, columns);
  for (Index a = 0; a < n; ++a)
    for (Index c = 0; c < columns; ++c) m(a, c) = low + (high - low) * random.next();
  return m;
}

}  // namespace interflect::solvers

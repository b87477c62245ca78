#pragma once

#include "solvers/block_product.h"
#include "solvers/cache_lines.h"
#include "solvers/solver.h"

namespace interflect::solvers {

/// Sweeps over the rows of K with the newest values, block of rows after block of rows: see `GaussSeidel`.  How a block
/// gets at what it receives from the others is for those that derive from it.
class Sweeps {
 public:
  virtual ~Sweeps() = default;
  virtual void forward() = 0;  ///< over all rows, from the first to the last
  virtual void back() = 0;     ///< from the last to the first

  ColumnMatrix radiosity() const { return x_.leftCols(n_).transpose(); }
  /// e + R G^-1 K b - b after a sweep, where K is symmetric; `back` of those by tiles does not know it.
  ColumnMatrix residual() const;

 protected:
  /// @param stride  of a column's unknowns, as many as there are or more: the rest is 0
  Sweeps(const System& system, double relaxation, const ColumnMatrix& start, Index stride, Index block_rows);
  Index n() const { return n_; }
  Index columns() const { return x_.rows(); }
  ConstColumnSpan x_from(Index first) const { return {x_.data() + first, columns(), x_.cols()}; }
  /// What the last block that was swept has changed by: columns x block_rows.
  ConstColumnSpan change() const { return {change_.data(), columns(), change_.cols()}; }
  ColumnSpan missing_from(Index first) { return {missing_.data() + first, columns(), missing_.cols()}; }

  /// Unknowns that follow each other, and what is known of all of them: a block, or a part of one.
  struct Rows {
    Index first, begin, end;   ///< of the block; of the part, counted from there
    Block diagonal;            ///< K of the part's rows and the block's unknowns
    ConstColumnSpan received;  ///< sum of K b over the unknowns outside the block, by row of the part
  };
  /// New values of rows of a block, one after the other, each with the newest of its block; and what is missing from
  /// those of it that came before them.
  void sweep(const Rows& rows, bool ascending);

  const System& system_;
  CacheLines values_;
  Eigen::Map<ColumnMatrix> x_;  ///< columns x stride, in values_: contiguous inner loops
  ColumnMatrix missing_;        ///< columns x stride: sum_b K_ab (b_b - b_b,before) over the b that were swept after a

 private:
  void update(const Rows& rows, Index i);
  void spread_within(const Rows& rows, bool ascending);

  Index n_;
  double relaxation_;
  ColumnMatrix own_;     ///< columns x unknowns: what its own step left of a row's residual
  ColumnMatrix change_;  ///< columns x block_rows
};

}  // namespace interflect::solvers

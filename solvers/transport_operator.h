#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/run.h"
#include "core/vec.h"
#include "solvers/layout.h"

namespace interflect::solvers {

using ColumnMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Columns = Eigen::Ref<ColumnMatrix>;  ///< owned unknowns x (groups * channels)
using ConstColumns = Eigen::Ref<const ColumnMatrix>;

/// Rows of K, or its columns, for solvers that need them: stored, or computed on demand.
class RowAccess {
 public:
  virtual ~RowAccess() = default;
  /// Rows first .. first + count into `out` (count x unknowns).  Reentrant: solvers share a block of rows among
  /// threads.
  virtual void rows(Index first, Index count, Columns out) const = 0;
  virtual Index evaluated() const = 0;  ///< rows handed out so far: the work in plots of error against work
};

class TileAccess;
class SparseRows;

/// h = G^-1 K b: what arrives when b leaves.  Geometry only: no reflectance and no pi left over.
///
///   K_ab = int int N_a(x) cos cos V / (pi r²) N_b(y) dy dx  [m²],   G_ab = int N_a N_b  [m²]
///   (diagonal; areas for constants)
class TransportOperator {
 public:
  virtual ~TransportOperator() = default;
  virtual const Layout& layout() const = 0;
  virtual bool symmetric() const = 0;  ///< K = K^T exactly: Galerkin yes, collocation no
  virtual void apply(ConstColumns b, Columns out, Run& run) const = 0;  ///< out = K b, all columns in one pass over K
  virtual std::span<const double> gram() const = 0;                     ///< diagonal of G [m²]
  virtual std::span<const double> self() const = 0;                     ///< K_aa [m²]
  virtual const RowAccess* rows() const { return nullptr; }
  /// Columns of K, each as a row: what one unknown sends to all.  Solvers that shoot need them.
  virtual const RowAccess* columns() const { return symmetric() ? rows() : nullptr; }
  /// The same as `rows` of a symmetric K, where it is stored in tiles, or few of its entries are.
  virtual const TileAccess* tiles() const { return nullptr; }
  virtual const SparseRows* sparse_rows() const { return nullptr; }
};

/// b = e + R h per channel; columns as in `Columns`.  Diagonal where reflectance is one number on an element.  Where it
/// varies inside, a block of the element's unknowns,
///
///   R_ab = 1/A int rho N_a N_b,     symmetric, with eigenvalues between the least and the largest rho
class Reflection {
 public:
  struct Block {
    Index first;                              ///< unknown
    std::vector<Eigen::MatrixXd> of_channel;  ///< functions x functions
  };

  explicit Reflection(ColumnMatrix reflectance) : reflectance_(std::move(reflectance)) {}
  /// @param reflectance  of the unknowns that are in no block; 0 for the others
  Reflection(ColumnMatrix reflectance, std::vector<Block> blocks)
      : reflectance_(std::move(reflectance)), blocks_(std::move(blocks)) {}

  const ColumnMatrix& reflectance() const { return reflectance_; }  ///< of unknowns in no block
  std::span<const Block> blocks() const { return blocks_; }
  bool diagonal() const { return blocks_.empty(); }
  void add_reflected(ConstColumns h, Columns b) const;
  /// Q >= 0 with Q Q = R.
  Reflection root() const;

 private:
  ColumnMatrix reflectance_;
  std::vector<Block> blocks_;
};

}  // namespace interflect::solvers

#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "fem/operator/symmetric_operator.h"
#include "solvers/tile_access.h"

namespace interflect::fem {

/// Every entry stored, in doubles, each pair once: 4 N² bytes.
///
/// The lower triangle lies in square tiles, row of tiles after row of tiles, each cut into parts of some rows
/// (solvers/tile_access.h), so that one pass over memory serves K_IJ and its mirror K_JI = K_IJ^T.  Symmetric by
/// construction: there is only one number a pair.
///
/// Standard errors of entries are kept in single precision, in tiles made when an entry in them was sampled: up to 2 N²
/// bytes more.  Bounds on quadrature errors are not kept: they are at most the tolerance that the method was given.
class DenseSymmetric final : public SymmetricOperator, public solvers::TileAccess, public ExchangeSink {
 public:
  /// All entries 0.  @param gram  of the unknowns: of constants the elements' areas [m²]  @param functions  of an
  /// element
  /// @throws core::InputError  where there is no memory for it
  explicit DenseSymmetric(std::vector<double> gram, Index functions = 1);
  ~DenseSymmetric() override;

  /// Sets K_ab = K_ba.  Threads may add at the same time as long as no pair is added twice.
  void add(Index a, Index b, const ExchangeEntry& entry) override;

  const solvers::Layout& layout() const override { return layout_; }
  /// Reads K once for up to any number of columns.  Same bits for any number of threads.
  void apply(solvers::ConstColumns b, solvers::Columns out, Run& run) const override;
  std::span<const double> gram() const override { return areas_; }
  std::span<const double> self() const override { return self_; }

  using SymmetricOperator::rows;
  void rows(Index first, Index count, solvers::Columns out) const override;
  Index evaluated() const override { return evaluated_.load(std::memory_order_relaxed); }

  const solvers::TileAccess* tiles() const override { return this; }
  const double* part(Index I, Index row, Index J) const override { return row_data(I, row, J); }

  double entry(Index a, Index b) const override;
  double entry_standard_error(Index a, Index b) const override;
  bool has_errors() const override;
  void apply_variances(solvers::ConstColumns b, solvers::Columns out, Run& run) const override;

  Index strips() const override { return static_cast<Index>(strips_.size()); }
  void visit(Index strip, const Visit& visit) const override;
  void change(const NewEntry& entry, Run& run) override;
  std::unique_ptr<SymmetricOperator> alike(std::vector<double> areas, const Fill& fill, Run& run) const override;

  double bytes() const override;

 private:
  /// Rows of tiles with about the same number of tiles: the unit of parallel work, the same for any number of threads.
  struct Strip {
    Index first, end;  ///< rows of tiles
  };
  class TiledColumns;
  struct Room;
  struct Free {
    void operator()(double* p) const;
  };

  /// Position of tile (I, J), I >= J, among all of them.
  static Index tile_at(Index I, Index J) { return I * (I + 1) / 2 + J; }
  /// A row of tile (I, J): parts of (I, 0) .. (I, I), and then the next ones.
  double* row_data(Index I, Index row, Index J) const {
    return entries_.get() + tile_at(I, 0) * solvers::tile_entries +
           (row / solvers::part_rows * (I + 1) + J) * solvers::part_entries +
           row % solvers::part_rows * solvers::tile_size;
  }
  float* error_tile(Index at);
  /// The pairs of a tile that are not 0 without an error, into room for all of them.
  std::span<const StoredPair> pairs_of(Index I, Index J, std::span<StoredPair> room) const;
  /// out = (a symmetric matrix) b, whose parts `rows_of(I, row, add)` gives to add(entries, J, tiles).
  template <class RowsOf>
  void multiply(const RowsOf& rows_of, solvers::ConstColumns b, solvers::Columns out, Run& run) const;
  template <class RowsOf>
  void multiply_strip(const Strip& strip, const RowsOf& rows_of, const TiledColumns& x, TiledColumns& sums) const;
  void add_sums(Index I, std::span<const TiledColumns> sums, solvers::Columns out) const;
  std::unique_ptr<Room> take_room(Index columns) const;
  void give_back(std::unique_ptr<Room> room) const;

  solvers::Layout layout_;
  std::vector<double> areas_, self_;
  Index tile_rows_;
  std::vector<Strip> strips_;
  std::unique_ptr<double[], Free> entries_;
  std::vector<std::atomic<float*>> errors_;  ///< per tile: null while all of its errors are 0
  mutable std::atomic<Index> evaluated_{0};
  /// Kept from one product to the next: fresh memory costs more time than what is done with it.
  mutable std::vector<std::unique_ptr<Room>> rooms_;
  mutable std::mutex rooms_mutex_;
};

}  // namespace interflect::fem

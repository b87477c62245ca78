#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "results/factor_points.h"
#include "results/factors.h"
#include "results/hdf5_file.h"

/// A matrix of view factors in an HDF5 file (docs/view_factor_files.md): the symmetric K_ij = A_i F_ij, computed tile
/// by tile.
namespace interflect::results {

/// What the numbers in a store depend on.
struct FactorStoreKey {
  std::string digest;    ///< geometry_digest
  std::string settings;  ///< JSON text: method, tolerance, seed; nothing that leaves the numbers alone, such as threads
};

/// Elements along the side of a tile: 512, or less where that leaves fewer than 32 tiles in a row, so that many threads
/// have work; at least 16.
Index usual_tile(Index elements);

/// A store that is being filled, under the name FILE.partial until it is finished: FILE is whole or the one of before.
///
/// A tile (I, J), I <= J, holds K of the elements I tile .. and J tile .., the last tiles as many as there are.  A
/// process that dies loses the tiles that it had not written; the next one goes on with the rest.  Every method may be
/// called from any thread.
class FactorStoreWriter {
 public:
  /// Begins a store, or goes on with FILE.partial.
  /// @param tile    elements along the side of a tile; 0: usual_tile; one that goes on keeps what it was begun with
  /// @param points  whose view factors the store has as well, a row for each
  /// @throws core::InputError  FILE.partial is of another geometry, of other settings or sensors, damaged, or open
  ///                           elsewhere; or no file can be written there
  FactorStoreWriter(std::filesystem::path file, const FactorElements& elements, const FactorStoreKey& key,
                    Index tile = 0, std::span<const measure::SensorPoint> points = {});

  Index size() const { return size_; }
  Index tile() const { return tile_; }
  Index tiles_across() const { return across_; }
  Index first(Index I) const { return I * tile_; }                          ///< element of a tile's rows or columns
  Index count(Index I) const { return std::min(tile_, size_ - first(I)); }  ///< how many
  bool is_done(Index I, Index J) const;
  /// Tiles (I, J), I <= J, that are written, by this run or an earlier one.
  Index done() const;
  Index tiles() const { return across_ * (across_ + 1) / 2; }

  /// @param K      count(I) x count(J) numbers [m²], row by row; symmetric where I == J
  /// @param error  of K [m²]: kept as floats, rounded up
  /// @throws core::InputError         the disk is full, ..: what was written before is good
  /// @throws core::PreconditionError  sizes that do not fit, I > J, or a number that is not one
  void write(Index I, Index J, std::span<const double> K, std::span<const double> error);
  /// A tile as it was written last, by this run or an earlier one; one that was not is 0.
  void read(Index I, Index J, std::span<double> K, std::span<double> error) const;

  bool is_point_done(Index s) const;
  /// Point view factors; fewer than there are elements: the rest is 0.
  void write_point(Index s, std::span<const double> F, std::span<const double> error);

  /// Sums the rows, and gives the file its name.  Nothing can be written afterwards.
  /// @throws core::PreconditionError  if a tile, or a point, is missing
  void finish();

 private:
  static Hdf5File begin(const std::filesystem::path& file, const FactorElements& elements, const FactorStoreKey& key,
                        Index tile, std::span<const measure::SensorPoint> points);
  void go_on(const FactorElements& elements, const FactorStoreKey& key, std::span<const measure::SensorPoint> points);
  void write_row_sums();

  std::filesystem::path file_, partial_;
  std::unique_ptr<Hdf5File> store_;  ///< none once finished
  Index size_ = 0, tile_ = 0, across_ = 0;
  mutable std::mutex mutex_;
  std::vector<std::uint8_t> done_;  ///< [I * across + J]
  std::vector<std::uint8_t> points_done_;
  std::vector<double> area_;
};

/// A finished store, for reading; from any thread.
class FactorStore {
 public:
  /// @throws core::InputError  not a store, cut short, or not finished: in one line
  explicit FactorStore(const std::filesystem::path& file);

  Index size() const { return elements_.size(); }
  const FactorElements& elements() const { return elements_; }
  const FactorStoreKey& key() const { return key_; }
  const std::vector<double>& row_sum() const { return row_sum_; }      ///< sum_j F_ij: 1 in a closed scene
  const std::vector<double>& row_error() const { return row_error_; }  ///< sum_j of the errors of F_ij
  /// @throws core::InputError  where that is not the digest of the geometry
  void require_geometry(const std::string& digest) const;

  /// Whole rows first .. first + count of K [m²] and of its errors: count x size() numbers each, row by row.  Fastest
  /// for multiples of tile().
  void read_rows(Index first, Index count, std::span<double> K, std::span<double> error) const;
  Index tile() const { return tile_; }

  /// Rows of F for the exports; they keep a tile's height of rows, and this store must outlive them.
  FactorRows rows() const;

  const std::vector<measure::SensorPoint>& points() const {
    return points_;
  }  ///< mostly none; on which surface they lie is not kept
  /// For the exports; this store must outlive them.
  PointFactors point_factors() const;

 private:
  void read_tile_rows(Index I, Index first, Index count, double* K, double* error) const;

  Hdf5File store_;
  FactorStoreKey key_;
  FactorElements elements_;
  std::vector<double> row_sum_, row_error_;
  std::vector<measure::SensorPoint> points_;
  Index tile_ = 0;
};

/// Bytes on the disk of what an interrupted run has left of a store.
double begun_bytes(const std::filesystem::path& file);
/// Most bytes that a store takes on the disk: of the matrix the tiles of the upper triangle alone, in the
/// usual size.
double factor_store_bytes(std::uint64_t elements, std::uint64_t points);

}  // namespace interflect::results

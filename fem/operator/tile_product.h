#pragma once

#include "core/vec.h"

/// The inner loops of the dense symmetric operator: a tile of K and its mirror times a few columns, at the speed of
/// memory.
namespace interflect::fem {

inline constexpr Index tile_size = 64;  ///< rows and columns of a tile: 32 kB
inline constexpr Index tile_entries = tile_size * tile_size;
inline constexpr Index tile_lanes = 4;  ///< sums that run side by side, over columns j = lane mod 4

/// A tile's part of a matrix of `columns` columns is one block of `columns` x tile_size doubles, column after column.
/// Sums over a row of tiles are kept per lane, columns x tile_size x tile_lanes, and added up once at its end:
/// add_lanes.
struct TileColumns {
  const double* x_rows;     ///< x at the tile's rows
  const double* x_columns;  ///< x at the tile's columns
  double* y_rows_lanes;     ///< += K x_columns, by lanes
  double* y_columns;        ///< += K^T x_rows
};

/// Both products for tile K (row-major), reading it once.  What lies behind it in memory is taken for the next tile and
/// fetched.
void add_tile_and_mirror(const double* K, Index columns, const TileColumns& at);
/// y_rows_lanes += K x_columns alone: for tiles on the diagonal, which are their own mirror.
void add_tile(const double* K, Index columns, const TileColumns& at);
/// y_rows += the sums of the lanes, which become 0.
void add_lanes(double* lanes, Index columns, double* y_rows);

}  // namespace interflect::fem

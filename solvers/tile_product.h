#pragma once

#include "solvers/tile_access.h"

/// The inner loops over a symmetric K in tiles: rows of tiles and their mirror times a few columns, at the speed of
/// memory.
namespace interflect::solvers {

inline constexpr Index tile_lanes = 8;    ///< sums that run side by side, over columns j = lane mod 8
inline constexpr Index rows_at_once = 4;  ///< numbers of rows are multiples of it

/// Rows of the parts of `tiles` tiles that follow each other, and the pieces of vectors that they take and give.  A
/// vector's columns lie `stride` apart; a tile's piece of one is tile_size contiguous values, the next one's lies `step`
/// behind.  Sums over a row are kept by lanes, column after column tile_size * tile_lanes apart, and added up once at
/// its end: add_lanes.
struct TileRows {
  Index rows, tiles, columns, stride, step;
  const double* receiving = nullptr;  ///< rows of the first tile, or null:  lanes += receiving x
  const double* x = nullptr;          ///< at the first tile's columns
  double* lanes = nullptr;            ///< of these rows
  const double* sending = nullptr;    ///< rows of a tile, the same or another's, or null:  y += sending^T z
  const double* z = nullptr;          ///< at these rows
  double* y = nullptr;                ///< at the first tile's columns
  const double* after = nullptr;      ///< what is read after the last tile, if it does not lie behind it
};

/// Both products, reading what is received from, and sent by, once.  What is read next, a part behind `receiving` (or
/// `sending`, where there is nothing else) or `after`, is fetched.  Same bits for any division into rows and tiles.
void add_products(const TileRows& of);

/// y += the sums of the lanes of `rows` rows, a multiple of tile_lanes, which become 0; y's columns lie `stride` apart.
void add_lanes(Index rows, Index columns, double* lanes, double* y, Index stride);

}  // namespace interflect::solvers

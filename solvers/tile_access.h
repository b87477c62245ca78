#pragma once

#include "core/vec.h"

namespace interflect::solvers {

inline constexpr Index tile_size = 64;  ///< rows and columns of a tile: 32 kB
inline constexpr Index tile_entries = tile_size * tile_size;
inline constexpr Index part_rows = 16;  ///< of a tile, which lie together: 8 kB
inline constexpr Index part_entries = part_rows * tile_size;

/// A symmetric K as it is stored, in square tiles of its lower triangle: for solvers that go over it in an order of
/// their own, and once.  A row of tiles is cut into parts, a few rows of all of its tiles, so that a few rows of K are
/// one piece of memory: what is fetched as fast as memory can.
class TileAccess {
 public:
  virtual ~TileAccess() = default;
  /// Rows `row` .. `row` + part_rows of K_IJ, J <= I, row-major, `row` a multiple of part_rows; 0 beyond the last
  /// unknown.  Those of K_I,J+1 follow.  A tile on the diagonal is whole.
  virtual const double* part(Index I, Index row, Index J) const = 0;
};

}  // namespace interflect::solvers

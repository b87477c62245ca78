#pragma once

#include "core/vec.h"

namespace interflect::solvers {

inline constexpr Index tile_size = 64;  ///< rows and columns of a tile: 32 kB
inline constexpr Index tile_entries = tile_size * tile_size;

/// A symmetric K as it is stored, in square tiles of its lower triangle: for solvers that go over it in an order of
/// their own, and once.
class TileAccess {
 public:
  virtual ~TileAccess() = default;
  /// K_IJ, J <= I, row-major; 0 beyond the last unknown.  A tile on the diagonal is whole.
  virtual const double* tile(Index I, Index J) const = 0;
};

}  // namespace interflect::solvers

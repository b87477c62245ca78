#pragma once

#include "fem/row_errors.h"

namespace interflect::fem {

/// Where a symmetric matrix and its errors go tile by tile: a file, mostly, larger than memory.
///
/// Tile (I, J), I <= J, holds the elements I size .. and J size .., the last tiles as many as there are, row by row.
class TileStore {
 public:
  virtual ~TileStore() = default;
  virtual Index tile_size() const = 0;
  virtual bool is_done(Index I, Index J) const = 0;  ///< by an earlier run
  /// From any thread; a tile may be written again.  K and its errors [m²]; symmetric where I == J.
  virtual void write(Index I, Index J, std::span<const double> K, std::span<const double> error) = 0;
  virtual void read(Index I, Index J, std::span<double> K, std::span<double> error) const = 0;
};

/// Two elements behind all others that see each other and nothing else, and what they exchange: a mask and what it
/// covers.
struct CoveredPair {
  Index a, b;  ///< a < b
  double K;    ///< [m²]
};

/// `assemble_to_tolerance` into a store; tiles that are done are left as they are, unless rows in them do not meet the
/// tolerance: then the entries of those rows are done again that err by more than a quarter of the tolerance over the
/// number of elements.  Errors are bound + 1.96 standard errors.  Methods that go by rows or all at once need 12 N²
/// bytes on the way.
/// @param covered  pairs that the method is not asked about: the store's last elements, behind the patches, two a pair
/// @throws core::Interrupted  with whole tiles written
ToleranceReport assemble_tiles(const MethodMaker& make, double tolerance, std::span<const scene::SurfacePatch> patches,
                               TileStore& store, Run& run, std::span<const CoveredPair> covered = {});

}  // namespace interflect::fem

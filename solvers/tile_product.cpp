#include "solvers/tile_product.h"

#include <algorithm>
#include <cassert>

#include "core/wide_vectors.h"
#include "solvers/tile_kernels.h"

namespace interflect::solvers {
namespace {

constexpr Index most_columns = 4;  // that a kernel takes

/// One column is read at the speed of memory with vectors of any width, and faster with short ones; more columns are
/// more than short vectors can multiply in that time, and so are two tiles.  Same bits with both.
TileKernels best_kernels() {
  TileKernels kernels = tile_kernels();
#ifdef INTERFLECT_WIDE_TILES
  if (!core::has_wide_vectors()) return kernels;
  const TileKernels wide = wide_tile_kernels();
  std::copy(wide.begin() + 1, wide.end(), kernels.begin() + 1);
  constexpr auto two_tiles = static_cast<std::size_t>(TileWork::two_tiles);
  kernels[0][two_tiles] = wide[0][two_tiles];
#endif
  return kernels;
}

TileWork work_of(const TileRows& of) {
  if (of.sending == nullptr) return TileWork::receive;
  if (of.receiving == nullptr) return TileWork::send;
  return of.receiving == of.sending ? TileWork::one_tile : TileWork::two_tiles;
}

/// The same of column `first` and those after it, `count` in all, and of one tile.
TileRows piece_of(const TileRows& all, Index tile, Index first, Index count) {
  TileRows of = all;
  of.tiles = 1;
  of.columns = count;
  if (all.receiving != nullptr) of.receiving += tile * part_entries;
  if (all.sending != nullptr) of.sending += tile * part_entries;
  if (all.receiving != nullptr) of.x += tile * all.step + first * all.stride;
  if (all.receiving != nullptr) of.lanes += first * tile_size * tile_lanes;
  if (all.sending != nullptr) of.z += first * all.stride;
  if (all.sending != nullptr) of.y += tile * all.step + first * all.stride;
  return of;
}

}  // namespace

void add_products(const TileRows& of) {
  static const TileKernels kernels = best_kernels();
  assert(of.rows % rows_at_once == 0 && (of.receiving != nullptr || of.sending != nullptr));
  const auto work = static_cast<std::size_t>(work_of(of));
  const auto kernel = [&](Index columns) { return kernels[static_cast<std::size_t>(columns - 1)][work]; };
  if (of.columns <= most_columns) return kernel(of.columns)(of);
  for (Index tile = 0; tile < of.tiles; ++tile)  // which is at hand when the first few columns are done
    for (Index first = 0; first < of.columns; first += most_columns) {
      const Index count = std::min(of.columns - first, most_columns);
      kernel(count)(piece_of(of, tile, first, count));
    }
}

void add_lanes(Index rows, Index columns, double* lanes, double* y, Index stride) {
  for (Index c = 0; c < columns; ++c)
    for (Index i = 0; i < rows; ++i) {
      double* of_row = lanes + (c * tile_size + i) * tile_lanes;
      double* sum = y + c * stride + i;
      *sum += ((of_row[0] + of_row[1]) + (of_row[2] + of_row[3])) + ((of_row[4] + of_row[5]) + (of_row[6] + of_row[7]));
      std::fill_n(of_row, tile_lanes, 0.0);
    }
}

}  // namespace interflect::solvers

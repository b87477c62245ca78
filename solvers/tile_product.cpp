#include "solvers/tile_product.h"

#include <algorithm>
#include <cassert>
#include <cstring>

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

using Eight [[gnu::vector_size(8 * sizeof(double))]] = double;
static_assert(tile_lanes == 8);

/// a0 + a1, a2 + a3, a4 + a5, a6 + a7, b0 + b1, ..
void pair_sums(const Eight& a, const Eight& b, Eight& sums) {
  sums = __builtin_shufflevector(a, b, 0, 2, 4, 6, 8, 10, 12, 14) +
         __builtin_shufflevector(a, b, 1, 3, 5, 7, 9, 11, 13, 15);
}

/// y += sums over the lanes of each of eight rows: pairs of lanes, then of those, then of those.
void add_eight_sums(double* lanes, double* y) {
  Eight of[8], sum;
  std::memcpy(of, lanes, sizeof(of));
  std::fill_n(lanes, 64, 0.0);
  for (int count = 8; count > 1; count /= 2)
    for (int i = 0; i < count; i += 2) pair_sums(of[i], of[i + 1], of[i / 2]);
  std::memcpy(&sum, y, sizeof(sum));
  sum += of[0];
  std::memcpy(y, &sum, sizeof(sum));
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
  assert(rows % tile_lanes == 0);
  for (Index c = 0; c < columns; ++c)
    for (Index i = 0; i < rows; i += tile_lanes)
      add_eight_sums(lanes + (c * tile_size + i) * tile_lanes, y + c * stride + i);
}

}  // namespace interflect::solvers

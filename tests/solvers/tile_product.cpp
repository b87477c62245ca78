#include "solvers/tile_product.h"

#include <gtest/gtest.h>

#include "solvers/cache_lines.h"
#include "tests/solvers/random_systems.h"

using namespace interflect;
using namespace interflect::solvers;

namespace {

constexpr Index all_lanes = tile_size * tile_lanes, tiles = 3, width = tiles * tile_size;

/// Parts of three tiles of two matrices, vectors, and what add_products makes of them by so many rows and tiles at a
/// time.
struct Products {
  Products(Index columns, std::uint64_t seed)
      : K(random_columns((tiles + 1) * part_rows, tile_size, -1, 1, seed)),  // with a part behind the last
        M(random_columns((tiles + 1) * part_rows, tile_size, -1, 1, seed + 1)),
        x(random_columns(columns, width, -1, 1, seed + 2)),
        z(random_columns(columns, width, -1, 1, seed + 3)) {}

  void run(const ColumnMatrix* receiving, const ColumnMatrix* sending, Index rows = part_rows, Index at_once = tiles) {
    const Index columns = x.rows();
    received = ColumnMatrix::Ones(columns, part_rows);
    sent = ColumnMatrix::Ones(columns, width);
    CacheLines lanes(columns * all_lanes);
    for (Index r = 0; r < part_rows; r += rows)
      for (Index t = 0; t < tiles; t += at_once)
        add_products({.rows = rows,
                      .tiles = std::min(at_once, tiles - t),
                      .columns = columns,
                      .stride = width,
                      .step = tile_size,
                      .receiving = receiving != nullptr ? receiving->row(t * part_rows + r).data() : nullptr,
                      .x = x.data() + t * tile_size,
                      .lanes = lanes.data() + r * tile_lanes,
                      .sending = sending != nullptr ? sending->row(t * part_rows + r).data() : nullptr,
                      .z = z.data() + r,
                      .y = sent.data() + t * tile_size});
    add_lanes(part_rows, columns, lanes.data(), received.data(), part_rows);
    for (Index i = 0; i < columns * all_lanes; ++i) EXPECT_EQ(lanes.data()[i], 0);
  }

  ColumnMatrix K, M, x, z, received, sent;
};

/// The rows that parts are of.
ColumnMatrix rows_of(const ColumnMatrix& parts) {
  ColumnMatrix rows(part_rows, width);
  for (Index t = 0; t < tiles; ++t)
    rows.middleCols(t * tile_size, tile_size) = parts.middleRows(t * part_rows, part_rows);
  return rows;
}

}  // namespace

// Sums of at most 192 products of numbers in [-1, 1]: rounding is below 192 2^-53 times the sum of magnitudes, at most
// 193.
TEST(TileProduct, equals_the_dense_product_for_any_number_of_columns_one_tile_or_two) {
  constexpr double rounding = 192 * 193 * 0x1p-53;
  for (Index columns = 1; columns <= 9; ++columns) {
    Products of(columns, 10 * static_cast<std::uint64_t>(columns));
    const ColumnMatrix ones = ColumnMatrix::Ones(columns, part_rows), all_ones = ColumnMatrix::Ones(columns, width);
    const auto sent_by = [&](const ColumnMatrix& parts) -> ColumnMatrix {
      return all_ones + of.z.leftCols(part_rows) * rows_of(parts);
    };
    const ColumnMatrix by_K = ones + of.x * rows_of(of.K).transpose(), from_K = sent_by(of.K), from_M = sent_by(of.M);
    of.run(&of.K, &of.K);
    EXPECT_LE((of.received - by_K).cwiseAbs().maxCoeff(), rounding) << columns;
    EXPECT_LE((of.sent - from_K).cwiseAbs().maxCoeff(), rounding) << columns;
    of.run(&of.K, &of.M);
    EXPECT_LE((of.received - by_K).cwiseAbs().maxCoeff(), rounding) << columns;
    EXPECT_LE((of.sent - from_M).cwiseAbs().maxCoeff(), rounding) << columns;
    of.run(&of.K, nullptr);
    EXPECT_LE((of.received - by_K).cwiseAbs().maxCoeff(), rounding) << columns;
    EXPECT_EQ(of.sent, all_ones);
    of.run(nullptr, &of.M);
    EXPECT_LE((of.sent - from_M).cwiseAbs().maxCoeff(), rounding) << columns;
    EXPECT_EQ(of.received, ones);
  }
}

TEST(TileProduct, has_the_same_bits_for_any_division_into_rows_tiles_and_columns) {
  for (const Index columns : {1, 3, 6}) {
    Products of(columns, 500);
    of.run(&of.K, &of.M);
    const ColumnMatrix received = of.received, sent = of.sent;
    for (const Index rows : {4, 8, 16})
      for (const Index at_once : {1, 2}) {
        of.run(&of.K, &of.M, rows, at_once);
        EXPECT_EQ(of.received, received) << rows << ' ' << at_once;
        EXPECT_EQ(of.sent, sent) << rows << ' ' << at_once;
      }
    // Every column alone is what it is among others: kernels of one column are for short vectors, of more for long
    // ones.
    for (Index c = 0; c < columns; ++c) {
      Products alone = of;
      alone.x = of.x.row(c);
      alone.z = of.z.row(c);
      for (const bool two : {false, true}) {
        alone.run(&alone.K, two ? &alone.M : &alone.K);
        of.run(&of.K, two ? &of.M : &of.K);
        EXPECT_EQ(alone.received, of.received.row(c)) << c;
        EXPECT_EQ(alone.sent, of.sent.row(c)) << c;
      }
    }
  }
}

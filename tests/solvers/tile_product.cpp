#include "solvers/tile_product.h"

#include <gtest/gtest.h>

#include "solvers/cache_lines.h"
#include "tests/solvers/random_systems.h"

using namespace interflect;
using namespace interflect::solvers;

namespace {

constexpr Index all_lanes = tile_size * tile_lanes;

/// Two tiles, vectors, and what add_products makes of them by `rows` rows at a time.
struct Products {
  Products(Index columns, std::uint64_t seed)
      : K(random_columns(2 * tile_size, tile_size, -1, 1, seed)),  // each with a tile behind it
        M(random_columns(2 * tile_size, tile_size, -1, 1, seed + 1)),
        x(random_columns(columns, tile_size, -1, 1, seed + 2)),
        z(random_columns(columns, tile_size, -1, 1, seed + 3)) {}

  void run(Index rows, const ColumnMatrix* receiving, const ColumnMatrix* sending) {
    const Index columns = x.rows();
    received = ColumnMatrix::Ones(columns, tile_size);
    sent = ColumnMatrix::Ones(columns, tile_size);
    CacheLines lanes(columns * all_lanes);
    for (Index r = 0; r < tile_size; r += rows)
      add_products({.rows = rows,
                    .columns = columns,
                    .stride = tile_size,
                    .receiving = receiving != nullptr ? receiving->row(r).data() : nullptr,
                    .x = x.data(),
                    .lanes = lanes.data() + r * tile_lanes,
                    .sending = sending != nullptr ? sending->row(r).data() : nullptr,
                    .z = z.data() + r,
                    .y = sent.data()});
    add_lanes(tile_size, columns, lanes.data(), received.data(), tile_size);
    for (Index i = 0; i < columns * all_lanes; ++i) EXPECT_EQ(lanes.data()[i], 0);
  }

  ColumnMatrix K, M, x, z, received, sent;
};

ColumnMatrix first_tile(const ColumnMatrix& K) { return K.topRows(tile_size); }

}  // namespace

// Sums of 64 products of numbers in [-1, 1]: rounding is below 64 2^-53 times the sum of magnitudes, at most 65.
TEST(TileProduct, equals_the_dense_product_for_any_number_of_columns_one_tile_or_two) {
  constexpr double rounding = 64 * 65 * 0x1p-53;
  for (Index columns = 1; columns <= 9; ++columns) {
    Products of(columns, 10 * static_cast<std::uint64_t>(columns));
    const ColumnMatrix one = ColumnMatrix::Ones(columns, tile_size);
    const ColumnMatrix by_K = one + of.x * first_tile(of.K).transpose(), from_K = one + of.z * first_tile(of.K),
                       from_M = one + of.z * first_tile(of.M);
    of.run(tile_size, &of.K, &of.K);
    EXPECT_LE((of.received - by_K).cwiseAbs().maxCoeff(), rounding) << columns;
    EXPECT_LE((of.sent - from_K).cwiseAbs().maxCoeff(), rounding) << columns;
    of.run(tile_size, &of.K, &of.M);
    EXPECT_LE((of.received - by_K).cwiseAbs().maxCoeff(), rounding) << columns;
    EXPECT_LE((of.sent - from_M).cwiseAbs().maxCoeff(), rounding) << columns;
    of.run(tile_size, &of.K, nullptr);
    EXPECT_LE((of.received - by_K).cwiseAbs().maxCoeff(), rounding) << columns;
    EXPECT_EQ(of.sent, one);
    of.run(tile_size, nullptr, &of.M);
    EXPECT_LE((of.sent - from_M).cwiseAbs().maxCoeff(), rounding) << columns;
    EXPECT_EQ(of.received, one);
  }
}

TEST(TileProduct, has_the_same_bits_for_any_division_into_rows_and_columns) {
  for (const Index columns : {1, 3, 6}) {
    Products of(columns, 500);
    of.run(tile_size, &of.K, &of.M);
    const ColumnMatrix received = of.received, sent = of.sent;
    for (const Index rows : {4, 8, 32}) {
      of.run(rows, &of.K, &of.M);
      EXPECT_EQ(of.received, received) << rows;
      EXPECT_EQ(of.sent, sent) << rows;
    }
    // Every column alone is what it is among others: kernels of one column are for short vectors, of more for long
    // ones.
    for (Index c = 0; c < columns; ++c) {
      Products alone = of;
      alone.x = of.x.row(c);
      alone.z = of.z.row(c);
      for (const ColumnMatrix* sending : {&alone.K, &alone.M}) {
        alone.run(tile_size, &alone.K, sending);
        of.run(tile_size, &of.K, sending == &alone.K ? &of.K : &of.M);
        EXPECT_EQ(alone.received, of.received.row(c)) << c;
        EXPECT_EQ(alone.sent, of.sent.row(c)) << c;
      }
    }
  }
}

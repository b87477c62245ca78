#include "solvers/block_product.h"

#include <gtest/gtest.h>

#include "tests/solvers/random_systems.h"

using namespace interflect;
using namespace interflect::solvers;

// Sums of n products of numbers in [-1, 1]: rounding is below n 2^-53 times the sum of magnitudes, itself at most n.
TEST(BlockProduct, equals_the_dense_product_for_any_shape) {
  for (const Index m : {1, 3, 4, 17, 64})
    for (const Index n : {1, 5, 31, 64, 131})
      for (const Index c : {1, 2, 3, 4, 5, 7, 8, 13}) {
        const ColumnMatrix K = random_columns(m, n, -1, 1, 1), x = random_columns(c, n, -1, 1, 2),
                           z = random_columns(c, m, -1, 1, 3);
        ColumnMatrix y = ColumnMatrix::Ones(c, m), w = ColumnMatrix::Ones(c, n);
        add_product({K.data(), m, n, n}, {x.data(), c, n}, {y.data(), c, m});
        add_transposed_product({K.data(), m, n, n}, {z.data(), c, m}, {w.data(), c, n});
        const double rounding = 0x1p-52 * static_cast<double>(std::max(m, n) * std::max(m, n));
        EXPECT_LE((y - ColumnMatrix::Ones(c, m) - x * K.transpose()).cwiseAbs().maxCoeff(), rounding)
            << m << ' ' << n << ' ' << c;
        EXPECT_LE((w - ColumnMatrix::Ones(c, n) - z * K).cwiseAbs().maxCoeff(), rounding) << m << ' ' << n << ' ' << c;
      }
}

TEST(BlockProduct, of_a_row_does_not_depend_on_the_block_that_it_lies_in) {
  const Index m = 23, n = 77, c = 3;
  const ColumnMatrix K = random_columns(m, n, -1, 1, 4), x = random_columns(c, n, -1, 1, 5);
  ColumnMatrix whole = ColumnMatrix::Zero(c, m), row_by_row = whole;
  add_product({K.data(), m, n, n}, {x.data(), c, n}, {whole.data(), c, m});
  for (Index i = 0; i < m; ++i)
    add_product({K.row(i).data(), 1, n, n}, {x.data(), c, n}, {row_by_row.data() + i, c, m});
  EXPECT_EQ(whole, row_by_row);
}

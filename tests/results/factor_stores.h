#pragma once

#include <gtest/gtest.h>

#include "factor_matrix.h"
#include "results/factor_store.h"

/// Stores of a matrix, written tile by tile.
namespace interflect::test {

using results::FactorStore;
using results::FactorStoreKey;
using results::FactorStoreWriter;

inline const FactorStoreKey key{"0123", "{\"method\": \"analytic\"}\n"};

inline void write_tile(FactorStoreWriter& store, const Matrix& matrix, Index I, Index J) {
  const auto i0 = static_cast<std::size_t>(store.first(I)), j0 = static_cast<std::size_t>(store.first(J));
  const auto rows = static_cast<std::size_t>(store.count(I)), columns = static_cast<std::size_t>(store.count(J));
  store.write(I, J, matrix.tile(matrix.K, i0, j0, rows, columns), matrix.tile(matrix.error, i0, j0, rows, columns));
}

/// Writes what is not done, but no more than `most` tiles; returns how many.
inline Index fill(FactorStoreWriter& store, const Matrix& matrix, Index most = 1000000) {
  Index written = 0;
  for (Index I = 0; I < store.tiles_across(); ++I)
    for (Index J = I; J < store.tiles_across(); ++J) {
      if (written == most || store.is_done(I, J)) continue;
      write_tile(store, matrix, I, J);
      ++written;
    }
  return written;
}

inline void write_store(const std::filesystem::path& file, const Matrix& matrix, Index tile) {
  FactorStoreWriter store(file, matrix.elements, key, tile);
  fill(store, matrix);
  store.finish();
}

inline void expect_holds(const std::filesystem::path& file, const Matrix& matrix) {
  const FactorStore store(file);
  const std::size_t n = matrix.size;
  ASSERT_EQ(store.size(), static_cast<Index>(n));
  EXPECT_EQ(store.key().digest, key.digest);
  EXPECT_EQ(store.key().settings, key.settings);
  EXPECT_EQ(store.elements().area, matrix.elements.area);
  EXPECT_EQ(store.elements().normal, matrix.elements.normal);
  EXPECT_EQ(store.elements().centroid, matrix.elements.centroid);
  EXPECT_EQ(store.elements().name, matrix.elements.name);
  std::vector<double> K(n * n), error(n * n), F(n), bound(n);
  store.read_rows(0, store.size(), K, error);
  EXPECT_EQ(K, matrix.K) << "to the last bit";
  const results::FactorRows rows = store.rows();
  for (std::size_t i = 0; i < n; ++i) {
    double sum = 0, sum_error = 0;
    rows(static_cast<Index>(i), F, bound);
    for (std::size_t j = 0; j < n; ++j) {
      const double given = matrix.error[i * n + j], kept = error[i * n + j];
      EXPECT_GE(kept, given) << "a bound stays one";
      EXPECT_LE(kept, given * (1 + 2e-7));
      EXPECT_EQ(F[j], matrix.K[i * n + j] / matrix.elements.area[i]);
      sum += F[j], sum_error += bound[j];
    }
    EXPECT_NEAR(store.row_sum()[i], sum, 1e-14 * sum);
    EXPECT_NEAR(store.row_error()[i], sum_error, 1e-14 * sum_error);
  }
}

}  // namespace interflect::test

#include "solvers/block_product.h"

#include <algorithm>
#include <cstring>

namespace interflect::solvers {
namespace {

#ifdef __AVX__
constexpr int lanes = 4;
#else
constexpr int lanes = 2;
#endif
using Pack [[gnu::vector_size(lanes * sizeof(double))]] = double;

inline Pack load(const double* p) {
  Pack v;
  std::memcpy(&v, p, sizeof v);
  return v;
}
inline void store(double* p, const Pack& v) { std::memcpy(p, &v, sizeof v); }
inline double sum(const Pack& v) {
  double s = v[0];
  for (int l = 1; l < lanes; ++l) s += v[l];
  return s;
}

/// R rows of K times C columns: R C sums in registers.
template <int C, int R>
inline void rows_times(const double* K, Index stride, Index n, const ConstColumnSpan& x, const ColumnSpan& y) {
  Pack s[R][C] = {};
  const Index whole = n - n % lanes;
  for (Index j = 0; j < whole; j += lanes) {
    Pack xj[C];
    for (int c = 0; c < C; ++c) xj[c] = load(x.values + c * x.stride + j);
    for (int r = 0; r < R; ++r) {
      const Pack k = load(K + r * stride + j);
      for (int c = 0; c < C; ++c) s[r][c] += k * xj[c];
    }
  }
  for (int r = 0; r < R; ++r)
    for (int c = 0; c < C; ++c) {
      double rest = 0;
      for (Index j = whole; j < n; ++j) rest += K[r * stride + j] * x.values[c * x.stride + j];
      y.values[c * y.stride + r] += sum(s[r][c]) + rest;
    }
}

template <int C>
void product(const Block& K, const ConstColumnSpan& x, const ColumnSpan& y) {
  constexpr int R = C == 4 ? 2 : 4;  // R C sums and C + 1 operands: 16 registers
  Index i = 0;
  for (; i + R <= K.m; i += R)
    rows_times<C, R>(K.entries + i * K.stride, K.stride, K.n, x, {y.values + i, y.columns, y.stride});
  for (; i < K.m; ++i)
    rows_times<C, 1>(K.entries + i * K.stride, K.stride, K.n, x, {y.values + i, y.columns, y.stride});
}

/// P packs of columns of K, transposed, times C columns.
template <int C, int P>
inline void columns_times(const double* K, Index stride, Index m, const ConstColumnSpan& x, const ColumnSpan& y) {
  Pack s[P][C];
  for (int p = 0; p < P; ++p)
    for (int c = 0; c < C; ++c) s[p][c] = load(y.values + c * y.stride + p * lanes);
  for (Index i = 0; i < m; ++i) {
    Pack xi[C];
    for (int c = 0; c < C; ++c) xi[c] = Pack{} + x.values[c * x.stride + i];
    for (int p = 0; p < P; ++p) {
      const Pack k = load(K + i * stride + p * lanes);
      for (int c = 0; c < C; ++c) s[p][c] += k * xi[c];
    }
  }
  for (int p = 0; p < P; ++p)
    for (int c = 0; c < C; ++c) store(y.values + c * y.stride + p * lanes, s[p][c]);
}

template <int C>
void transposed_product(const Block& K, const ConstColumnSpan& x, const ColumnSpan& y) {
  constexpr int P = C == 4 ? 2 : 4;
  Index j = 0;
  const auto at = [&](Index k) { return ColumnSpan{y.values + k, y.columns, y.stride}; };
  for (; j + P * lanes <= K.n; j += P * lanes) columns_times<C, P>(K.entries + j, K.stride, K.m, x, at(j));
  for (; j + lanes <= K.n; j += lanes) columns_times<C, 1>(K.entries + j, K.stride, K.m, x, at(j));
  for (; j < K.n; ++j)
    for (int c = 0; c < C; ++c)
      for (Index i = 0; i < K.m; ++i)
        y.values[c * y.stride + j] += K.entries[i * K.stride + j] * x.values[c * x.stride + i];
}

/// by(C, x, y) for the columns in groups of at most four.
template <class By>
inline void in_groups(const ConstColumnSpan& x, const ColumnSpan& y, const By& by) {
  for (Index c = 0; c < x.columns; c += 4) {
    const Index group = std::min<Index>(4, x.columns - c);
    by(group, ConstColumnSpan{x.values + c * x.stride, group, x.stride},
       ColumnSpan{y.values + c * y.stride, group, y.stride});
  }
}

}  // namespace

void add_product(const Block& K, const ConstColumnSpan& x, const ColumnSpan& y) {
  in_groups(x, y, [&](Index columns, const ConstColumnSpan& u, const ColumnSpan& v) {
    switch (columns) {
      case 1:
        return product<1>(K, u, v);
      case 2:
        return product<2>(K, u, v);
      case 3:
        return product<3>(K, u, v);
      default:
        return product<4>(K, u, v);
    }
  });
}

void add_transposed_product(const Block& K, const ConstColumnSpan& x, const ColumnSpan& y) {
  in_groups(x, y, [&](Index columns, const ConstColumnSpan& u, const ColumnSpan& v) {
    switch (columns) {
      case 1:
        return transposed_product<1>(K, u, v);
      case 2:
        return transposed_product<2>(K, u, v);
      case 3:
        return transposed_product<3>(K, u, v);
      default:
        return transposed_product<4>(K, u, v);
    }
  });
}

}  // namespace interflect::solvers

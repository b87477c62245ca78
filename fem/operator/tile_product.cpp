#include "fem/operator/tile_product.h"

#include <cstring>
#include <utility>

namespace interflect::fem {
namespace {

using Pack [[gnu::vector_size(tile_lanes * sizeof(double))]] = double;
static_assert(tile_lanes == 4);

/// f(0), f(1), .. f(N - 1), each with a constant: arrays indexed so stay in registers.
template <int N, class F>
[[gnu::always_inline]] inline void each(const F& f) {
  [&]<int... i>(std::integer_sequence<int, i...>) { (f(std::integral_constant<int, i>{}), ...); }
  (std::make_integer_sequence<int, N>{});
}

// By reference: a Pack as a value has a calling convention of its own where registers are shorter than it.
[[gnu::always_inline]] inline void load(Pack& v, const double* p) { std::memcpy(&v, p, sizeof v); }
[[gnu::always_inline]] inline void store(double* p, const Pack& v) { std::memcpy(p, &v, sizeof v); }

/// R rows of K: lanes += K x_columns and, with the mirror, y += K^T x_rows, reading K once.
template <int C, int R, bool mirror>
[[gnu::always_inline]] inline void rows_product(const double* K, const double* x, double* lanes, const double* x_rows,
                                                double* y) {
  Pack s[R][C], xi[R][C];
  each<R>([&](auto r) {
    each<C>([&](auto c) {
      load(s[r][c], lanes + (c * tile_size + r) * tile_lanes);
      const double v = x_rows[c * tile_size + r];
      xi[r][c] = Pack{v, v, v, v};
    });
  });
  for (Index j = 0; j < tile_size; j += tile_lanes) {
    // The tile behind this one, line by line, into the second-level cache: K is read once and from memory.
    __builtin_prefetch(K + tile_entries + R * j, 0, 2);
    if constexpr (R == 4) __builtin_prefetch(K + tile_entries + R * j + 8, 0, 2);
    Pack k[R];
    each<R>([&](auto r) { load(k[r], K + r * tile_size + j); });
    // Column after column: two registers for what is read once, all others for what is used again.
    each<C>([&](auto c) {
      Pack xj, yj;
      load(xj, x + c * tile_size + j);
      if constexpr (mirror) load(yj, y + c * tile_size + j);
      each<R>([&](auto r) {
        s[r][c] += k[r] * xj;
        if constexpr (mirror) yj += k[r] * xi[r][c];
      });
      if constexpr (mirror) store(y + c * tile_size + j, yj);
    });
  }
  each<R>([&](auto r) { each<C>([&](auto c) { store(lanes + (c * tile_size + r) * tile_lanes, s[r][c]); }); });
}

template <int C, bool mirror>
void product(const double* K, const TileColumns& at) {
  constexpr int R = C <= 2 ? 4 : 2;  // R C + C sums and some of the C + R C operands: 16 registers
  for (Index r = 0; r < tile_size; r += R)
    rows_product<C, R, mirror>(K + r * tile_size, at.x_columns, at.y_rows_lanes + r * tile_lanes, at.x_rows + r,
                               at.y_columns);
}

template <bool mirror>
void all_columns(const double* K, Index columns, TileColumns at) {
  while (columns > 0) {
    const Index group = columns < 4 ? columns : 4;
    switch (group) {
      case 1:
        product<1, mirror>(K, at);
        break;
      case 2:
        product<2, mirror>(K, at);
        break;
      case 3:
        product<3, mirror>(K, at);
        break;
      default:
        product<4, mirror>(K, at);
        break;
    }
    columns -= group;
    if (columns == 0) break;
    at.x_rows += group * tile_size;
    at.x_columns += group * tile_size;
    at.y_rows_lanes += group * tile_size * tile_lanes;
    at.y_columns += group * tile_size;
  }
}

}  // namespace

void add_tile_and_mirror(const double* K, Index columns, const TileColumns& at) { all_columns<true>(K, columns, at); }

void add_tile(const double* K, Index columns, const TileColumns& at) { all_columns<false>(K, columns, at); }

void add_lanes(double* lanes, Index columns, double* y_rows) {
  for (Index i = 0; i < columns * tile_size; ++i, lanes += tile_lanes) {
    y_rows[i] += (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]);
    for (Index l = 0; l < tile_lanes; ++l) lanes[l] = 0;
  }
}

}  // namespace interflect::fem

#pragma once

#include <array>
#include <cstring>
#include <utility>

#include "solvers/tile_product.h"

/// The loops of `add_products`, which files with flags of their own make for several instruction sets: all in a
/// namespace without a name, so that none is taken for another.
namespace interflect::solvers {

using TileKernel = void (*)(const TileRows& of);
enum class TileWork { receive, send, one_tile, two_tiles };
/// kernel[columns - 1][work]
using TileKernels = std::array<std::array<TileKernel, 4>, 4>;

TileKernels tile_kernels();       ///< for the processors that all is built for
TileKernels wide_tile_kernels();  ///< with vectors of 64 bytes

namespace {

/// The lanes of a sum, in as many vectors as they take.
#ifdef __AVX512F__
constexpr int vector_lanes = 8;
#else
constexpr int vector_lanes = 4;
#endif
constexpr int parts = tile_lanes / vector_lanes;
using Vector [[gnu::vector_size(vector_lanes * sizeof(double))]] = double;

/// f(0), f(1), .. f(N - 1), each with a constant: arrays indexed so stay in registers.
template <int N, class F>
[[gnu::always_inline]] inline void each(const F& f) {
  [&]<int... i>(std::integer_sequence<int, i...>) { (f(std::integral_constant<int, i>{}), ...); }
  (std::make_integer_sequence<int, N>{});
}

// By reference: a vector as a value has a calling convention of its own where registers are shorter than it.
struct Lanes {
  Vector part[parts];
};
[[gnu::always_inline]] inline void load(Lanes& v, const double* p) {
  each<parts>([&](auto i) { std::memcpy(&v.part[i], p + i * vector_lanes, sizeof(Vector)); });
}
[[gnu::always_inline]] inline void store(double* p, const Lanes& v) {
  each<parts>([&](auto i) { std::memcpy(p + i * vector_lanes, &v.part[i], sizeof(Vector)); });
}

/// How many rows of C columns fit in registers.  Of two tiles one at a time where columns are many: what waits for the
/// second-level cache then waits beside others.
template <int C, TileWork work>
constexpr int rows_in_registers() {
#ifdef __AVX512F__
  if (work == TileWork::two_tiles && C >= 3) return 1;
  return C <= 3 ? 4 : 2;
#else
  return C == 1 ? 4 : C == 2 ? 2 : 1;
#endif
}

/// R rows of tile t from `row` on.
template <int C, int R, TileWork work>
[[gnu::always_inline]] inline void rows_product(const TileRows& of, Index t, Index row) {
  constexpr bool receives = work != TileWork::send, sends = work != TileWork::receive;
  // Member by member, each as it was written: a copy of them all at once would wait for all stores before it, and those
  // for K.  What is stored in y could lie in `of`, as far as the compiler knows.
  const Index at = t * part_entries + row * tile_size;
  const double* in = of.receiving + (receives ? at : 0);
  const double* out = work == TileWork::one_tile ? in : of.sending + (sends ? at : 0);
  const bool goes_on = of.after == nullptr || t + 1 < of.tiles;
  const double* next = goes_on ? (receives ? in : out) + part_entries : of.after + row * tile_size;
  const double* x_columns = of.x + (receives ? t * of.step : 0);
  double* y_columns = of.y + (sends ? t * of.step : 0);
  double* lanes = of.lanes + (receives ? row * tile_lanes : 0);
  const Index stride = of.stride;
  Lanes s[R][C];
  Vector z[R][C];
  each<R>([&](auto r) {
    each<C>([&](auto c) {
      if constexpr (receives) load(s[r][c], lanes + (c * tile_size + r) * tile_lanes);
      if constexpr (sends) z[r][c] = Vector{} + of.z[c * stride + row + r];
    });
  });
  for (Index j = 0; j < tile_size; j += tile_lanes) {
    // The part behind this one, line by line, into the first-level cache: K is read once and from memory, and what only
    // came to the second level would wait once more, in the queue that those from memory fill.
    each<R>([&](auto r) { __builtin_prefetch(next + R * j + r * tile_lanes, 0, 3); });
    Lanes k[R], m[R];
    each<R>([&](auto r) {
      if constexpr (receives) load(k[r], in + r * tile_size + j);
      if constexpr (work == TileWork::one_tile)
        m[r] = k[r];
      else if constexpr (sends)
        load(m[r], out + r * tile_size + j);
    });
    // Column after column: registers for what is read once are few.
    each<C>([&](auto c) {
      Lanes x, y;
      if constexpr (receives) load(x, x_columns + c * stride + j);
      if constexpr (sends) load(y, y_columns + c * stride + j);
      each<R>([&](auto r) {
        each<parts>([&](auto i) {
          if constexpr (receives) s[r][c].part[i] += k[r].part[i] * x.part[i];
          if constexpr (sends) y.part[i] += m[r].part[i] * z[r][c];
        });
      });
      if constexpr (sends) store(y_columns + c * stride + j, y);
    });
  }
  if constexpr (receives)
    each<R>([&](auto r) { each<C>([&](auto c) { store(lanes + (c * tile_size + r) * tile_lanes, s[r][c]); }); });
}

template <int C, TileWork work>
void product(const TileRows& of) {
  constexpr int R = rows_in_registers<C, work>();
  const Index rows = of.rows, tiles = of.tiles;
  for (Index t = 0; t < tiles; ++t)
    for (Index row = 0; row < rows; row += R) rows_product<C, R, work>(of, t, row);
}

template <int C>
constexpr std::array<TileKernel, 4> kernels_of() {
  return {product<C, TileWork::receive>, product<C, TileWork::send>, product<C, TileWork::one_tile>,
          product<C, TileWork::two_tiles>};
}
constexpr TileKernels all_kernels() { return {kernels_of<1>(), kernels_of<2>(), kernels_of<3>(), kernels_of<4>()}; }

}  // namespace
}  // namespace interflect::solvers

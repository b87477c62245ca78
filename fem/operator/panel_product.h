#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "core/vec.h"

/// The inner loop of the sparse symmetric operator: pairs of a panel of rows times a few columns.
namespace interflect::fem {

inline constexpr Index panel_rows = 64;

/// Rows of a row-major matrix from number `first` on, `stride` apart.
template <class T>
struct RowsOf {
  T* values;
  Index stride, first;
  T* row(Index a) const { return values + (a - first) * stride; }
};

/// For pairs (i, j) at places 64 j + i - first_row, ascending:  y_i += K x_j and y_j += K x_i.
/// What a column gives stays in registers.
template <Index C, class Value>
void add_pairs(std::span<const std::uint32_t> places, Index first_row, const Value& value, RowsOf<const double> x,
               RowsOf<double> y) {
  for (std::size_t k = 0; k < places.size();) {
    const Index j = places[k] / panel_rows;
    std::array<double, C> x_j, of_column{};
    std::copy_n(x.row(j), C, x_j.begin());
    for (; k < places.size() && places[k] / panel_rows == j; ++k) {
      const Index i = first_row + places[k] % panel_rows;
      const double K = value(k), mirrored = i == j ? 0.0 : K;
      for (Index c = 0; c < C; ++c) {
        y.row(i)[c] += K * x_j[static_cast<std::size_t>(c)];
        of_column[static_cast<std::size_t>(c)] += mirrored * x.row(i)[c];
      }
    }
    for (Index c = 0; c < C; ++c) y.row(j)[c] += of_column[static_cast<std::size_t>(c)];
  }
}

/// All columns of x and y, up to four at a time.
template <class Value>
void add_pairs(std::span<const std::uint32_t> places, Index first_row, const Value& value, Index columns,
               RowsOf<const double> x, RowsOf<double> y) {
  for (; columns > 0; columns -= 4, x.values += 4, y.values += 4) switch (std::min<Index>(columns, 4)) {
      case 1:
        add_pairs<1>(places, first_row, value, x, y);
        break;
      case 2:
        add_pairs<2>(places, first_row, value, x, y);
        break;
      case 3:
        add_pairs<3>(places, first_row, value, x, y);
        break;
      default:
        add_pairs<4>(places, first_row, value, x, y);
    }
}

}  // namespace interflect::fem

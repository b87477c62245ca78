#pragma once

#include <span>
#include <vector>

#include "core/spectrum.h"
#include "solvers/transport_operator.h"

namespace interflect::fem {

/// Spectra as columns, one per channel in use, and back; unused channels are 0.
inline solvers::ColumnMatrix to_columns(std::span<const Spectrum> values, int channels) {
  solvers::ColumnMatrix columns(static_cast<Index>(values.size()), channels);
  for (std::size_t i = 0; i < values.size(); ++i)
    for (int c = 0; c < channels; ++c) columns(static_cast<Index>(i), c) = values[i][c];
  return columns;
}

/// Of one number a channel: a row of columns, or what is computed of such.
template <class Row>
Spectrum to_spectrum(const Eigen::DenseBase<Row>& row) {
  Spectrum value;
  for (Index c = 0; c < row.size(); ++c) value[static_cast<int>(c)] = row.derived().coeff(c);
  return value;
}

inline std::vector<Spectrum> to_spectra(const solvers::ColumnMatrix& columns) {
  std::vector<Spectrum> values;
  values.reserve(static_cast<std::size_t>(columns.rows()));
  for (Index i = 0; i < columns.rows(); ++i) values.push_back(to_spectrum(columns.row(i)));
  return values;
}

/// Row i divided by areas[i]: flux to flux per area.
inline void divide_by(solvers::ColumnMatrix& columns, std::span<const double> areas) {
  for (Index i = 0; i < columns.rows(); ++i) columns.row(i) /= areas[static_cast<std::size_t>(i)];
}

}  // namespace interflect::fem

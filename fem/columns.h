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

inline std::vector<Spectrum> to_spectra(const solvers::ColumnMatrix& columns) {
  std::vector<Spectrum> values(static_cast<std::size_t>(columns.rows()));
  for (std::size_t i = 0; i < values.size(); ++i)
    for (int c = 0; c < columns.cols(); ++c) values[i][c] = columns(static_cast<Index>(i), c);
  return values;
}

/// Row i divided by areas[i]: flux to flux per area.
inline void divide_by(solvers::ColumnMatrix& columns, std::span<const double> areas) {
  for (Index i = 0; i < columns.rows(); ++i) columns.row(i) /= areas[static_cast<std::size_t>(i)];
}

}  // namespace interflect::fem

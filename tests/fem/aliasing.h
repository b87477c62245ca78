#pragma once

#include <cmath>

#include "fem/form_factor/max_cells.h"

namespace interflect::fem::test {

/// What aliasing alone makes of a form factor, for edges of total length `edges` [rad]: max_cells.h.
inline double aliasing(const HemicubeGrid& grid, double edges) {
  return std::sqrt(edges * edge_error(grid) / (12 * pi * pi));
}

}  // namespace interflect::fem::test

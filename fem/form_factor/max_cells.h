#pragma once

#include "fem/form_factor/hemicube_grid.h"

namespace interflect::fem {

/// Cells of a hemicube that err least, on the average over random edges, for their number; after the idea of [Max 1995]
/// "Optimal sampling for hemicubes", IEEE TVCG 1(1): boundaries that are not uniform, and proportions that are not
/// those of a cube, to minimise the expected square of a form factor's error.  The derivation and the numbers here are
/// our own.
///
/// An edge that crosses a row of cells is rounded, in that row, to the nearest boundary: an error of variance f²/12 for
/// a cell's form factor f.  A steep edge is rounded row by row, a flat one column by column; so an edge of a given
/// direction is rounded max(rows, columns) times where it crosses so many of them.  Edges without a preferred direction
/// are great circles of the sphere, and the mean of that maximum over all directions is 2/pi times the mean length d of
/// a cell's two diagonals, as angles (|a| v |b| is (|a+b| + |a-b|) / 2, and a + b and a - b are the diagonals).  Edges
/// of total length l, anywhere above the horizon, so give
///
///   E[(F_h - F)²] = l J / (12 pi²),   J = sum over cells of f² d
///
/// Cells of one face lie between lines x = x_i and y = y_j, so that polygons are drawn on them row by row as ever.  J
/// is least for about (t in [-1, 1] on the top and across a side, in [0, 1] up a side; a = 1 / height is half the top's
/// width)
///
///   height 1.44,   x, y = a tan(0.74 t) / tan(0.74),   across x = tan(0.856 t) / tan(0.856),
///   up z = height tan(1.035 t^0.598) / tan(1.035)
///
/// whose J is 0.56 of that of equal cells on half a cube, and 0.76 of that of rows and columns of equal form factor
/// there.  Other counts of rows and columns gain less than one per cent more.  Test: tests/fem/hemicube_sight.cpp,
/// where random triangles agree with the formula.
///
/// @param resolution  as many cells as HemicubeGrid::uniform has; even, at least 2   @throws core::PreconditionError
HemicubeGrid max_cells(int resolution);

/// J above [sr^(1/2)].
double edge_error(const HemicubeGrid& grid);

}  // namespace interflect::fem

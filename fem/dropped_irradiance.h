#pragma once

#include "fem/operator/symmetric_operator.h"

namespace interflect::fem {

/// The most irradiance that entries which an operator left out may have brought [as B], per element and channel:
///
///   max sum_j x_j |B_j|   over  0 <= x_j <= t min(1, A_j / A_i),  x_j = 0 where K_ij is stored,  sum_j x_j = d_i
///
/// with t = drop_below() and d_i = dropped()[i]: all that is known of the F_ij that were dropped.  The brightest
/// elements first.  A bound for this B; far below d_i max |B| where few elements are bright, since none of them can
/// have more than t.
/// @param B  radiosity, size() x channels
solvers::ColumnMatrix dropped_irradiance(const SymmetricOperator& K, const solvers::ColumnMatrix& B, const Run& run);

}  // namespace interflect::fem

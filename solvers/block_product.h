#pragma once

#include "core/vec.h"

/// Products of a small block of K with a few columns: the inner loops of operators and solvers.  Multiply-adds on
/// registers through gcc's and clang's vector types, so that they run at the speed of memory on any processor.
namespace interflect::solvers {

/// A block of a row-major matrix: m x n entries, rows `stride` apart.
struct Block {
  const double* entries;
  Index m, n, stride;
};

/// Columns that lie one after the other, `stride` apart (each column contiguous).
struct ConstColumnSpan {
  const double* values;
  Index columns, stride;
};
struct ColumnSpan {
  double* values;
  Index columns, stride;
};

/// y += K x.  x has n values a column, y has m.  The order of every sum depends on n alone.
void add_product(const Block& K, const ConstColumnSpan& x, const ColumnSpan& y);

/// y += K^T x.  x has m values a column, y has n.  The order of every sum depends on m alone.
void add_transposed_product(const Block& K, const ConstColumnSpan& x, const ColumnSpan& y);

}  // namespace interflect::solvers

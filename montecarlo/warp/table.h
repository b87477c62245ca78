#pragma once

#include <span>
#include <vector>

#include "core/vec.h"

namespace interflect::montecarlo {

/// A row of cells with weights: picks one with the probability weight / sum, and where in it, from one number.  A cell
/// of weight 0 is never picked.
class CellRow {
 public:
  explicit CellRow(std::span<const double> weights);  ///< >= 0

  double total() const { return before_.back(); }
  double weight(int cell) const { return before_[at(cell) + 1] - before_[at(cell)]; }
  struct Picked {
    int cell;
    double within;  ///< 0 .. 1
  };
  /// @param u  uniform in [0, 1); the total must not be 0
  Picked pick(double u) const;
  double inverse(const Picked& picked) const {
    return (before_[at(picked.cell)] + picked.within * weight(picked.cell)) / total();
  }

 private:
  static std::size_t at(int cell) { return static_cast<std::size_t>(cell); }
  std::vector<double> before_;  ///< sums of the weights before each cell, and of all
  int last_ = 0;                ///< cell that weighs anything
};

/// Cells in rows and columns: a row by its sum, then a cell of it.  (u, v) -> (row, column) with the places within.
class CellTable {
 public:
  /// @param weights  row by row
  CellTable(int rows, int columns, std::span<const double> weights);

  double total() const { return rows_.total(); }
  double probability(int row, int column) const {
    return of_row_[static_cast<std::size_t>(row)].weight(column) / total();
  }
  struct Picked {
    CellRow::Picked row, column;
  };
  Picked pick(double u, double v) const;
  Vec2 inverse(const Picked& picked) const;

 private:
  std::vector<CellRow> of_row_;
  CellRow rows_;
};

}  // namespace interflect::montecarlo

#pragma once

#include <cstddef>
#include <vector>

namespace interflect::fem {

/// What an eye has seen of each item, as form factors from its point.
///
/// A cell that an edge cuts, being counted in whole or not at all, errs with variance f²/12 in each row that a steep
/// edge crosses, or in each column that a flat one does (max_cells.h).  The cells along an edge are as many as rows and
/// columns together, on the average over directions sqrt(2) times as many as the greater of the two: hence 12 sqrt(2) =
/// 17.  Test: tests/fem/hemicube_sight.cpp
struct SeenItems {
  std::vector<double> visible;  ///< summed over cells
  std::vector<double> covered;  ///< the same if nothing hid it; left 0 by ways that do not know it
  std::vector<double>
      border;  ///< sum of the squares of cells that its edges may cut: about 17 times the variance of `visible`
  std::vector<double> beyond;  ///< of the part outside of the view, if nothing hid it

  void clear(std::size_t items) {
    for (std::vector<double>* values : {&visible, &covered, &border, &beyond}) values->assign(items, 0);
  }
};

}  // namespace interflect::fem

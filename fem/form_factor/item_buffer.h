#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "fem/form_factor/hemicube_grid.h"
#include "fem/form_factor/seen_items.h"
#include "fem/form_factor/view_plane.h"

namespace interflect::fem {

/// A Z-buffer over the cells of one face: which item each cell's sample sees.
///
/// A polygon has the samples in it and on its edges (within 1e-12 of the face's width), so that no sample falls between
/// neighbours, with or without common corners; of two at one depth the first stays.
class ItemBuffer {
 public:
  static constexpr std::int32_t sky = -1, nothing_of_interest = -2;  ///< items that are not counted

  explicit ItemBuffer(const FaceGrid& grid);  ///< the grid outlives the buffer
  void clear();
  /// @return  the form factor that it would have if nothing hid it
  double add(const ProjectedPolygon& polygon, std::int32_t item);
  void count(SeenItems& seen) const;

  const FaceGrid& grid() const { return grid_; }
  std::int32_t item(int i, int j) const { return item_[at(i, j)]; }
  double nearness(int i, int j) const { return nearness_[at(i, j)]; }  ///< 1 / depth [1/m], 0 for the sky

 private:
  struct Rows {
    int begin, end;
  };
  std::size_t at(int i, int j) const { return static_cast<std::size_t>(std::ptrdiff_t{j} * grid_.x.cells() + i); }
  Rows find_spans(const ProjectedPolygon& polygon);
  void widen_spans(double x_from, double y_from, double x_to, double y_to);
  void count_borders(int j, SeenItems& seen) const;

  const FaceGrid& grid_;
  double rounding_;            ///< of projected coordinates
  std::vector<double> until_;  ///< sums of weights along a row, from its beginning
  std::vector<double> nearness_;
  std::vector<std::int32_t> item_;
  std::vector<double> left_, right_;  ///< of the polygon at hand, per row
};

}  // namespace interflect::fem

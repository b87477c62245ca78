#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/box.h"

namespace interflect::geometry {

/// Boxes in the cells of a uniform grid, about half as large as boxes are in the mean: which boxes may hold a point, at
/// once. For many boxes of like sizes, as elements of a surface have; a tree (box_tree.h) does for others.
class BoxGrid {
 public:
  BoxGrid() = default;
  explicit BoxGrid(std::span<const Box> boxes);

  /// Positions in the boxes given: all that hold x, and others near it.  First those that fill most of x's cell, which
  /// likely hold it, equal ones in their order.
  std::span<const std::uint32_t> near(const Vec3& x) const {
    if (first_.empty()) return {};
    const std::size_t cell = index({at(0, x), at(1, x), at(2, x)});
    return std::span(items_).subspan(first_[cell], first_[cell + 1] - first_[cell]);
  }

 private:
  /// Monotone in x, so that a point of a box is in a cell between those of the box's corners.
  std::uint32_t at(int axis, const Vec3& x) const {
    const double place = (x[axis] - low_[axis]) * per_length_[axis];
    if (!(place > 0)) return 0;
    const std::uint32_t last = cells_[static_cast<std::size_t>(axis)] - 1;
    return place < last ? static_cast<std::uint32_t>(place) : last;
  }
  std::size_t index(const std::array<std::uint32_t, 3>& cell) const {
    return (std::size_t{cell[2]} * cells_[1] + cell[1]) * cells_[0] + cell[0];
  }
  void choose_cells(const Box& all, const Vec3& mean_sides, double boxes);
  template <class Visit>
  void for_cells(const Box& box, const Visit& visit) const;
  void sort_by_overlap(std::span<const Box> boxes);

  Vec3 low_ = Vec3::Zero(), per_length_ = Vec3::Zero();
  std::array<std::uint32_t, 3> cells_{1, 1, 1};
  std::vector<std::uint32_t> first_, items_;
};

}  // namespace interflect::geometry

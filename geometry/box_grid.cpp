#include "geometry/box_grid.h"

#include <algorithm>
#include <cmath>

namespace interflect::geometry {

BoxGrid::BoxGrid(std::span<const Box> boxes) {
  if (boxes.empty()) return;
  Box all;
  Vec3 sides = Vec3::Zero();
  for (const Box& box : boxes) {
    all.extend(box);
    sides += box.sizes();
  }
  choose_cells(all, sides / static_cast<double>(boxes.size()), static_cast<double>(boxes.size()));
  first_.assign(std::size_t{cells_[0]} * cells_[1] * cells_[2] + 1, 0);
  for (const Box& box : boxes) for_cells(box, [&](std::size_t cell) { ++first_[cell + 1]; });
  for (std::size_t cell = 1; cell < first_.size(); ++cell) first_[cell] += first_[cell - 1];
  items_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::uint32_t k = 0; k < boxes.size(); ++k)
    for_cells(boxes[k], [&](std::size_t cell) { items_[next[cell]++] = k; });
}

/// As many along each axis as boxes fit there, but not eight times as many as there are boxes.
void BoxGrid::choose_cells(const Box& all, const Vec3& mean_sides, double boxes) {
  Vec3 count;
  for (int axis = 0; axis < 3; ++axis)
    count[axis] = mean_sides[axis] > 0 ? std::max(1.0, all.sizes()[axis] / mean_sides[axis]) : 1.0;
  const double too_many = count.prod() / (8 * boxes);
  if (too_many > 1) count = (count / std::cbrt(too_many)).cwiseMax(1.0);
  low_ = all.min();
  for (int axis = 0; axis < 3; ++axis) {
    const double cells = std::min(std::floor(count[axis]), 65536.0);
    cells_[static_cast<std::size_t>(axis)] = static_cast<std::uint32_t>(cells);
    per_length_[axis] = all.sizes()[axis] > 0 ? cells / all.sizes()[axis] : 0;
  }
}

template <class Visit>
void BoxGrid::for_cells(const Box& box, const Visit& visit) const {
  const Vec3 &low = box.min(), &high = box.max();
  for (std::uint32_t z = at(2, low); z <= at(2, high); ++z)
    for (std::uint32_t y = at(1, low); y <= at(1, high); ++y)
      for (std::uint32_t x = at(0, low); x <= at(0, high); ++x) visit(index({x, y, z}));
}

}  // namespace interflect::geometry

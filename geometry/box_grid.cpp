#include "geometry/box_grid.h"

#include <algorithm>
#include <cmath>
#include <functional>

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
  sort_by_overlap(boxes);
}

void BoxGrid::sort_by_overlap(std::span<const Box> boxes) {
  std::array<std::uint32_t, 3> cell{};
  // Of those axes alone that are cut: along others boxes may be flat.
  const auto overlap = [&](std::uint32_t item) {
    double product = 1;
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      if (cells_[a] == 1) continue;
      const double low = low_[axis] + cell[a] / per_length_[axis], high = low + 1 / per_length_[axis];
      product *= std::min(high, boxes[item].max()[axis]) - std::max(low, boxes[item].min()[axis]);
    }
    return product;
  };
  for (cell[2] = 0; cell[2] < cells_[2]; ++cell[2])
    for (cell[1] = 0; cell[1] < cells_[1]; ++cell[1])
      for (cell[0] = 0; cell[0] < cells_[0]; ++cell[0]) {
        const std::size_t at = index(cell);
        const auto items = std::span(items_).subspan(first_[at], first_[at + 1] - first_[at]);
        std::ranges::stable_sort(items, std::greater<>(), overlap);
      }
}

/// Twice as many along each axis as boxes fit there, so that the first one of a cell often holds all of it, but not
/// eight times as many as there are boxes.
void BoxGrid::choose_cells(const Box& all, const Vec3& mean_sides, double boxes) {
  Vec3 count;
  for (int axis = 0; axis < 3; ++axis)
    count[axis] = mean_sides[axis] > 0 ? std::max(1.0, 2 * all.sizes()[axis] / mean_sides[axis]) : 1.0;
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

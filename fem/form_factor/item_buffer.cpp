#include "fem/form_factor/item_buffer.h"

#include <algorithm>
#include <limits>

namespace interflect::fem {

ItemBuffer::ItemBuffer(const FaceGrid& grid)
    : grid_(grid), rounding_(1e-12 * (grid.x.boundaries().back() - grid.x.boundaries().front())) {
  for (int j = 0; j < grid.y.cells(); ++j) {
    until_.push_back(0);
    for (int i = 0; i < grid.x.cells(); ++i) until_.push_back(until_.back() + grid.weight_at(i, j));
  }
  left_.resize(static_cast<std::size_t>(grid.y.cells()));
  right_.resize(left_.size());
  clear();
}

void ItemBuffer::clear() {
  nearness_.assign(grid_.weight.size(), 0);
  item_.assign(grid_.weight.size(), sky);
}

/// An edge bounds the polygon's span in each row that it crosses.
void ItemBuffer::widen_spans(double x_from, double y_from, double x_to, double y_to) {
  if (y_from > y_to) std::swap(x_from, x_to), std::swap(y_from, y_to);
  const double slope = y_to > y_from ? (x_to - x_from) / (y_to - y_from) : 0;
  const auto [low, high] = std::minmax(x_from, x_to);
  const std::vector<double>& rows = grid_.y.samples();
  for (auto j = static_cast<std::size_t>(grid_.y.first_from(y_from - rounding_));
       j < rows.size() && rows[j] <= y_to + rounding_; ++j) {
    const bool flat = y_to - y_from < rounding_;
    const double x = std::clamp(x_from + slope * (rows[j] - y_from), low, high);
    left_[j] = std::min(left_[j], flat ? low : x);
    right_[j] = std::max(right_[j], flat ? high : x);
  }
}

ItemBuffer::Rows ItemBuffer::find_spans(const ProjectedPolygon& polygon) {
  const auto corners = static_cast<std::size_t>(polygon.corners);
  const auto [low, high] = std::minmax_element(polygon.y.begin(), polygon.y.begin() + polygon.corners);
  const Rows rows{grid_.y.first_from(*low - rounding_), grid_.y.first_from(*high + rounding_)};
  if (rows.begin == rows.end) return rows;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::fill(left_.begin() + rows.begin, left_.begin() + rows.end, infinity);
  std::fill(right_.begin() + rows.begin, right_.begin() + rows.end, -infinity);
  for (std::size_t k = 0; k < corners; ++k) {
    const std::size_t next = k + 1 < corners ? k + 1 : 0;
    widen_spans(polygon.x[k], polygon.y[k], polygon.x[next], polygon.y[next]);
  }
  return rows;
}

double ItemBuffer::add(const ProjectedPolygon& polygon, std::int32_t item) {
  if (polygon.corners < 3) return 0;
  const Rows rows = find_spans(polygon);
  double covered = 0;
  for (int j = rows.begin; j < rows.end; ++j) {
    const auto row = static_cast<std::size_t>(j);
    if (left_[row] > right_[row]) continue;
    const int begin = grid_.x.first_from(left_[row] - rounding_), end = grid_.x.first_from(right_[row] + rounding_);
    if (begin >= end) continue;
    const double* until = until_.data() + row * static_cast<std::size_t>(grid_.x.cells() + 1);
    covered += until[end] - until[begin];
    const double q = polygon.q0 + polygon.qy * grid_.y.samples()[row], qx = polygon.qx;
    const double* const x = grid_.x.samples().data();
    double* const nearness = nearness_.data() + at(0, j);
    std::int32_t* const items = item_.data() + at(0, j);
    for (int i = begin; i < end; ++i) {  // without branches: the compiler makes vectors of it
      const double here = q + qx * x[i];
      const bool nearer = here > nearness[i];
      nearness[i] = nearer ? here : nearness[i];
      items[i] = nearer ? item : items[i];
    }
  }
  return covered;
}

/// Between the cells of row j and those to their right and above, where the items differ.
void ItemBuffer::count_borders(int j, SeenItems& seen) const {
  const int columns = grid_.x.cells();
  const std::int32_t *const here = item_.data() + at(0, j), *const above =
                                                                j + 1 < grid_.y.cells() ? here + columns : here;
  const double *const w = grid_.weight.data() + at(0, j), *const w_above = w + (above - here);
  const auto add = [&seen](std::int32_t item, double square) {
    if (item >= 0) seen.border[static_cast<std::size_t>(item)] += square;
  };
  for (int i = 0; i < columns; ++i) {
    if (here[i] != above[i]) add(here[i], w[i] * w_above[i]), add(above[i], w[i] * w_above[i]);
    if (i + 1 < columns && here[i] != here[i + 1]) add(here[i], w[i] * w[i + 1]), add(here[i + 1], w[i] * w[i + 1]);
  }
}

void ItemBuffer::count(SeenItems& seen) const {
  const int columns = grid_.x.cells();
  for (int j = 0; j < grid_.y.cells(); ++j) {
    const std::int32_t* const items = item_.data() + at(0, j);
    const double* const until = until_.data() + static_cast<std::size_t>(j) * static_cast<std::size_t>(columns + 1);
    for (int begin = 0; begin < columns;) {
      int end = begin + 1;
      while (end < columns && items[end] == items[begin]) ++end;
      if (items[begin] >= 0) seen.visible[static_cast<std::size_t>(items[begin])] += until[end] - until[begin];
      begin = end;
    }
    count_borders(j, seen);
  }
}

}  // namespace interflect::fem

#include "fem/form_factor/warnock.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fem/form_factor/hemicube_grid.h"

namespace interflect::fem {

namespace {

constexpr double rounding =
    1e-12;  ///< of projected coordinates, relative to a cell or absolute: neighbours shall leave no gap
constexpr int deepest = 40;  ///< cells this small are rounding, whatever was asked for

double factor_of(double x, double y, double half) {
  const double x0 = x - half, x1 = x + half, y0 = y - half, y1 = y + half;
  return (factor_across(x1, y1) - factor_across(x0, y1)) - (factor_across(x1, y0) - factor_across(x0, y0));
}

}  // namespace

void Warnock::add(const ProjectedPolygon& projected, std::int32_t item) {
  if (projected.corners < 3) return;
  const auto corners = static_cast<std::size_t>(projected.corners);
  double doubled = 0;
  for (std::size_t k = 2; k < corners; ++k)
    doubled += (projected.x[k - 1] - projected.x[0]) * (projected.y[k] - projected.y[0]) -
               (projected.x[k] - projected.x[0]) * (projected.y[k - 1] - projected.y[0]);
  const double sign = doubled < 0 ? -1 : 1;
  Polygon polygon{};
  for (std::size_t k = 0; k < corners; ++k) {
    const std::size_t next = k + 1 < corners ? k + 1 : 0;
    const double dx = projected.x[next] - projected.x[k], dy = projected.y[next] - projected.y[k],
                 length = std::hypot(dx, dy);
    if (length == 0) continue;
    const double a = -sign * dy / length, b = sign * dx / length;
    polygon.edge[static_cast<std::size_t>(polygon.edges++)] = {a, b, -(a * projected.x[k] + b * projected.y[k])};
  }
  const auto [x_low, x_high] = std::minmax_element(projected.x.begin(), projected.x.begin() + projected.corners);
  const auto [y_low, y_high] = std::minmax_element(projected.y.begin(), projected.y.begin() + projected.corners);
  polygon.x_low = *x_low, polygon.x_high = *x_high, polygon.y_low = *y_low, polygon.y_high = *y_high;
  polygon.q0 = projected.q0, polygon.qx = projected.qx, polygon.qy = projected.qy;
  polygon.item = item;
  polygons_.push_back(polygon);
}

Warnock::Place Warnock::place(const Polygon& polygon, const Cell& cell) {
  if (polygon.x_low > cell.x + cell.half || polygon.x_high < cell.x - cell.half || polygon.y_low > cell.y + cell.half ||
      polygon.y_high < cell.y - cell.half)
    return Place::outside;
  Place found = Place::surrounding;
  for (int k = 0; k < polygon.edges; ++k) {
    const Line& edge = polygon.edge[static_cast<std::size_t>(k)];
    const double middle = edge.at(cell.x, cell.y), reach = cell.half * (std::abs(edge.a) + std::abs(edge.b)),
                 slack = rounding * (1 + reach);
    if (middle < -reach - slack) return Place::outside;
    if (middle < reach - slack) found = Place::crossing;
  }
  return found;
}

/// Of candidates that were just appended, all that lie behind one that covers the whole cell are dropped.
void Warnock::keep_the_nearest(const Cell& cell, std::size_t begin, std::size_t end) {
  double nearest = 0;
  std::size_t cover = end;
  for (std::size_t k = begin; k < end; ++k) {
    const std::uint32_t index = stack_[k].polygon;
    const Polygon& polygon = polygons_[index];
    const Place where = stack_[k].surrounds ? Place::surrounding : place(polygon, cell);
    if (where == Place::outside) continue;
    const double middle = polygon.nearness(cell.x, cell.y),
                 reach = cell.half * (std::abs(polygon.qx) + std::abs(polygon.qy));
    stack_.push_back({index, where == Place::surrounding, middle - reach, middle + reach});
    if (where == Place::surrounding && middle - reach > nearest) nearest = middle - reach, cover = stack_.size() - 1;
  }
  if (cover == end) return;
  std::size_t kept = end;
  for (std::size_t k = end; k < stack_.size(); ++k)
    if (k == cover || stack_[k].most > nearest) stack_[kept++] = stack_[k];
  stack_.resize(kept);
}

void Warnock::sample(const Cell& cell, double factor, std::size_t begin, SeenItems& seen) const {
  double nearest = 0;
  std::int32_t item = -1;
  for (std::size_t k = begin; k < stack_.size(); ++k) {
    const Polygon& polygon = polygons_[stack_[k].polygon];
    if (polygon.item >= 0) seen.border[static_cast<std::size_t>(polygon.item)] += factor * factor;
    const double nearness = polygon.nearness(cell.x, cell.y);
    if (nearness > nearest && place(polygon, {cell.x, cell.y, 0}) != Place::outside)
      nearest = nearness, item = polygon.item;
  }
  if (item >= 0) seen.visible[static_cast<std::size_t>(item)] += factor;
}

/// @param begin, end  candidates of the cell's parent, on the stack
void Warnock::visit(const Cell& cell, std::size_t begin, std::size_t end, SeenItems& seen) {
  const std::size_t own = stack_.size();
  keep_the_nearest(cell, begin, end);
  const std::size_t count = stack_.size() - own;
  if (count == 1 && stack_[own].surrounds) {
    const std::int32_t item = polygons_[stack_[own].polygon].item;
    if (item >= 0) seen.visible[static_cast<std::size_t>(item)] += factor_of(cell.x, cell.y, cell.half);
  } else if (count > 0) {
    const double factor = factor_of(cell.x, cell.y, cell.half);
    if (factor <= small_ || cell.half < std::ldexp(half_side_, -deepest)) {
      sample(cell, factor, own, seen);
    } else {
      const double half = 0.5 * cell.half;
      const std::size_t all = stack_.size();
      for (const double dy : {-half, half})
        for (const double dx : {-half, half}) visit({cell.x + dx, cell.y + dy, half}, own, all, seen);
    }
  }
  stack_.resize(own);
}

void Warnock::count(SeenItems& seen) {
  stack_.clear();
  for (std::uint32_t k = 0; k < polygons_.size(); ++k) stack_.push_back({k, false, 0, 0});
  visit({0, 0, half_side_}, 0, stack_.size(), seen);
}

}  // namespace interflect::fem

#include "scene/sensor.h"

#include <algorithm>
#include <cmath>

namespace interflect::scene {
namespace {

constexpr double most_cells = 1e9;  // along one side

double spacing_of_en12464(double longer, double shorter) {
  const double d = longer >= 2 * shorter ? shorter : longer;
  return std::min(10.0, 0.2 * std::pow(5.0, std::log10(d)));
}

}  // namespace

std::array<std::int64_t, 2> cell_counts(const SensorGrid& grid) {
  if (const auto* given = std::get_if<Eigen::Array2i>(&grid.step)) return {(*given)[0], (*given)[1]};
  const double u = grid.u.norm() - 2 * grid.exclude_border, v = grid.v.norm() - 2 * grid.exclude_border;
  double spacing = std::get<double>(grid.step);
  if (std::isnan(spacing)) spacing = spacing_of_en12464(std::max(u, v), std::min(u, v));
  const auto cells = [=](double length) {
    return static_cast<std::int64_t>(std::llround(std::clamp(length / spacing, 1.0, most_cells)));
  };
  return {cells(u), cells(v)};
}

}  // namespace interflect::scene

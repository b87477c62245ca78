#include "fem/form_factor/adaptive_lambert.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fem/form_factor/adaptive_cells.h"
#include "fem/form_factor/point_to_polygon.h"

namespace interflect::fem {

namespace {

constexpr double rounding = 0.5 * std::numeric_limits<double>::epsilon();

/// F_{dA -> inner}, above the horizon.
struct Lambert {
  using Value = double;
  Vec3 normal;
  std::span<const Vec3> inner;

  double at(const Vec3& x) const { return point_to_polygon_above_horizon(x, normal, inner); }
  static double zero() { return 0; }
  static double size(double value) { return std::abs(value); }
  static double least(double a, double b) { return std::min(a, b); }
  static double greatest(double a, double b) { return std::max(a, b); }
};

/// Of Lambert's sum over angles, integrated: the angles are at most perimeter / distance, and 2 pi.
double rounding_of(std::span<const Vec3> outer, const Vec3& normal, std::span<const Vec3> inner) {
  double area = 0.0, perimeter = 0.0;
  for (std::size_t k = 2; k < outer.size(); ++k)
    area += 0.5 * normal.dot((outer[k - 1] - outer[0]).cross(outer[k] - outer[0]));
  for (std::size_t k = 0; k < inner.size(); ++k) perimeter += (inner[(k + 1) % inner.size()] - inner[k]).norm();
  return 2 * rounding * std::abs(area) * std::min(1.0, 0.5 * inv_pi * perimeter / standing(outer, inner).distance);
}

}  // namespace

const CellScheme& cell_scheme(double tolerance) {
  static const CellScheme loose{{triangle_rule(5), quad_rule(3)}, 0.1, 2e-4, 6, 0.016};
  static const CellScheme tight{{triangle_rule(8), quad_rule(6)}, 0.02, 1e-6, 10, 0.001};
  return tolerance < 1e-7 ? tight : loose;
}

Integral adaptive_lambert(std::span<const Vec3> outer, const Vec3& normal, std::span<const Vec3> inner,
                          const LambertEffort& effort) {
  const Lambert integrand{normal, inner};
  AdaptiveCells<Lambert> cells(integrand, inner, cell_scheme(effort.tolerance));
  cells.cover(outer);
  const double least = rounding_of(outer, normal, inner);
  const auto enough = [&] {
    return cells.error() <= std::max(least, effort.tolerance * cells.value() - least) || cells.value() <= 0.0;
  };
  while (!enough() && cells.cells() < effort.most_cells) cells.cut_worst();
  const auto [value, error] = cells.result();
  return {value, error + least};
}

double expected_lambert_error(std::span<const Vec3> outer, std::span<const Vec3> inner) {
  const double s = standing(outer, inner).ratio();
  return s < rough_from ? 4e-4 * std::pow(s, 7) : 2e-2;
}

}  // namespace interflect::fem

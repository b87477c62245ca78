#include "fem/form_factor/max_cells.h"

#include <cmath>

#include "core/error.h"
#include "core/vec.h"

namespace interflect::fem {

namespace {

// Where J is least at 64 cells across; it is flat there, and the same at 32 and 128 to the digits that matter.
constexpr double height = 1.44, top_bend = 0.74, across_bend = 0.856, up_bend = 1.035, up_power = 0.598;

/// [-1, 1] to itself: steps that widen away from the middle.
double bent(double t, double bend) { return std::abs(t) == 1 ? t : std::tan(bend * t) / std::tan(bend); }

double angle(const Vec3& a, const Vec3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

double edge_error(const FaceGrid& grid, bool side) {
  const auto direction = [side](double x, double y) { return side ? Vec3(x, 1, y) : Vec3(x, y, 1); };
  const std::vector<double>&x = grid.x.boundaries(), &y = grid.y.boundaries();
  double sum = 0;
  for (std::size_t j = 0; j + 1 < y.size(); ++j)
    for (std::size_t i = 0; i + 1 < x.size(); ++i) {
      const double f = grid.weight_at(static_cast<int>(i), static_cast<int>(j));
      const double diagonals = angle(direction(x[i], y[j]), direction(x[i + 1], y[j + 1])) +
                               angle(direction(x[i + 1], y[j]), direction(x[i], y[j + 1]));
      sum += 0.5 * f * f * diagonals;
    }
  return sum;
}

}  // namespace

HemicubeGrid max_cells(int resolution) {
  if (resolution < 2 || resolution % 2 != 0)
    throw core::PreconditionError("max_cells: an even resolution of at least 2 expected");
  const CellAxis top = CellAxis::warped(resolution, [](double t) { return bent(2 * t - 1, top_bend) / height; });
  const CellAxis across = CellAxis::warped(resolution, [](double t) { return bent(2 * t - 1, across_bend); });
  const CellAxis up =
      CellAxis::warped(resolution / 2, [](double t) { return height * bent(std::pow(t, up_power), up_bend); });
  return HemicubeGrid::of(height, top, top, across, up);
}

double edge_error(const HemicubeGrid& grid) { return edge_error(grid.top, false) + 4 * edge_error(grid.side, true); }

}  // namespace interflect::fem

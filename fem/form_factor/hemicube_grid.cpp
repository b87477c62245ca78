#include "fem/form_factor/hemicube_grid.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/vec.h"

namespace interflect::fem {

namespace {

using Corner = double (*)(double, double);

/// Integrals over cells from those over rectangles at the origin.
FaceGrid with_exact_weights(CellAxis x, CellAxis y, Corner from_corner) {
  FaceGrid grid{std::move(x), std::move(y), {}};
  const auto row = [&](double at) {
    std::vector<double> factors;
    for (const double boundary : grid.x.boundaries()) factors.push_back(from_corner(boundary, at));
    return factors;
  };
  std::vector<double> below = row(grid.y.boundaries().front());
  for (std::size_t j = 1; j < grid.y.boundaries().size(); ++j) {
    std::vector<double> above = row(grid.y.boundaries()[j]);
    for (std::size_t i = 1; i < above.size(); ++i)
      grid.weight.push_back((above[i] - above[i - 1]) - (below[i] - below[i - 1]));
    below = std::move(above);
  }
  return grid;
}

FaceGrid with_midpoint_weights(CellAxis x, CellAxis y, Corner density) {
  FaceGrid grid{std::move(x), std::move(y), {}};
  for (std::size_t j = 0; j < grid.y.samples().size(); ++j)
    for (std::size_t i = 0; i < grid.x.samples().size(); ++i) {
      const double dx = grid.x.boundaries()[i + 1] - grid.x.boundaries()[i],
                   dy = grid.y.boundaries()[j + 1] - grid.y.boundaries()[j];
      grid.weight.push_back(density(grid.x.samples()[i], grid.y.samples()[j]) * dx * dy);
    }
  return grid;
}

double density_across(double x, double y) {
  const double square = x * x + y * y + 1;
  return inv_pi / (square * square);
}
double density_beside(double y, double z) { return z * density_across(y, z); }

/// Where an increasing function on [low, high] takes a value between its ends.
double where(const std::function<double(double)>& f, double value, double low, double high) {
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (f(middle) < value ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// Equal parts of an increasing function on [low, high].
CellAxis equal_parts(int cells, double low, double high, const std::function<double(double)>& f) {
  const double from = f(low), to = f(high);
  return CellAxis::warped(cells, [&](double t) {
    if (t == 0 || t == 1) return t == 0 ? low : high;  // faces meet without a gap
    return where(f, from + t * (to - from), low, high);
  });
}

void require_even(int resolution) {
  if (resolution < 2 || resolution % 2 != 0)
    throw core::PreconditionError("HemicubeGrid: an even resolution of at least 2 expected");
}

}  // namespace

CellAxis::CellAxis(std::vector<double> boundaries, std::vector<double> samples)
    : boundaries_(std::move(boundaries)), samples_(std::move(samples)) {
  const std::size_t bins = 2 * samples_.size();
  const double length = boundaries_.back() - boundaries_.front();
  bins_per_length_ = static_cast<double>(bins) / length;
  last_bin_ = static_cast<double>(bins - 1);
  for (std::size_t bin = 0; bin < bins; ++bin) {
    // One bin earlier: rounding in first_from may take a coordinate to the bin after its own.
    const double begin = boundaries_.front() + length * (static_cast<double>(bin) - 1) / static_cast<double>(bins);
    start_.push_back(static_cast<int>(std::lower_bound(samples_.begin(), samples_.end(), begin) - samples_.begin()));
  }
}

CellAxis CellAxis::warped(int cells, const std::function<double(double)>& warp) {
  std::vector<double> boundaries, samples;
  for (int k = 0; k <= cells; ++k) boundaries.push_back(warp(static_cast<double>(k) / cells));
  for (int k = 0; k < cells; ++k) samples.push_back(warp((k + 0.5) / cells));
  return {std::move(boundaries), std::move(samples)};
}

CellAxis CellAxis::uniform(double low, double high, int cells) {
  return warped(cells, [&](double t) { return low + t * (high - low); });
}

double FaceGrid::sum() const {
  double sum = 0;
  for (int j = 0; j < y.cells(); ++j) {  // row by row: so many small numbers would lose a digit otherwise
    double row = 0;
    for (int i = 0; i < x.cells(); ++i) row += weight_at(i, j);
    sum += row;
  }
  return sum;
}

double factor_across(double x, double y) {
  const double a = std::sqrt(1 + x * x), b = std::sqrt(1 + y * y);
  return 0.5 * inv_pi * (x / a * std::atan(y / a) + y / b * std::atan(x / b));
}

double factor_beside(double y, double z) {
  const double a = std::sqrt(1 + z * z);
  return 0.5 * inv_pi * (std::atan(y) - std::atan(y / a) / a);
}

HemicubeGrid HemicubeGrid::of(double height, CellAxis top_x, CellAxis top_y, CellAxis side_x, CellAxis side_y) {
  return {height, with_exact_weights(std::move(top_x), std::move(top_y), factor_across),
          with_exact_weights(std::move(side_x), std::move(side_y), factor_beside)};
}

HemicubeGrid HemicubeGrid::uniform(int resolution, CellWeights weights) {
  require_even(resolution);
  const CellAxis across = CellAxis::uniform(-1, 1, resolution), up = CellAxis::uniform(0, 1, resolution / 2);
  if (weights == CellWeights::exact) return of(1, across, across, across, up);
  return {1, with_midpoint_weights(across, across, density_across), with_midpoint_weights(across, up, density_beside)};
}

HemicubeGrid HemicubeGrid::equal_factor(int resolution) {
  require_even(resolution);
  const CellAxis top = equal_parts(resolution, -1, 1, [](double x) { return factor_across(x, 1); });
  const CellAxis across = equal_parts(resolution, -1, 1, [](double x) { return factor_beside(x, 1); });
  const CellAxis up = equal_parts(resolution / 2, 0, 1, [](double z) { return factor_beside(1, z); });
  return of(1, top, top, across, up);
}

}  // namespace interflect::fem

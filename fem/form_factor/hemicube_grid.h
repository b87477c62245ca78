#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace interflect::fem {

/// Cells along one axis of a view plane, and in each the coordinate at which it is looked through.
class CellAxis {
 public:
  CellAxis() = default;
  /// @param boundaries  increasing, one more than samples   @param samples  one in each cell
  CellAxis(std::vector<double> boundaries, std::vector<double> samples);
  /// Boundaries warp(k / cells), samples warp((k + 1/2) / cells), for an increasing function on [0, 1].
  static CellAxis warped(int cells, const std::function<double(double)>& warp);
  static CellAxis uniform(double low, double high, int cells);

  int cells() const { return static_cast<int>(samples_.size()); }
  const std::vector<double>& boundaries() const { return boundaries_; }
  const std::vector<double>& samples() const { return samples_; }
  /// The first cell whose sample is x or more; `cells()` if there is none.
  int first_from(double x) const {
    const double at = (x - boundaries_.front()) * bins_per_length_;
    int k = at > 0 ? start_[at < last_bin_ ? static_cast<std::size_t>(at) : static_cast<std::size_t>(last_bin_)] : 0;
    while (k < cells() && samples_[static_cast<std::size_t>(k)] < x) ++k;
    return k;
  }

 private:
  std::vector<double> boundaries_, samples_;
  std::vector<int> start_;  ///< per bin of equal length: the first sample at its beginning or later
  double bins_per_length_ = 0, last_bin_ = 0;
};

enum class CellWeights { exact, midpoint };

/// Form factors from the eye to the cells of one face, row by row: weight[j * x.cells() + i].
struct FaceGrid {
  CellAxis x, y;
  std::vector<double> weight;

  double weight_at(int i, int j) const { return weight[static_cast<std::size_t>(std::ptrdiff_t{j} * x.cells() + i)]; }
  double sum() const;
};

/// F from a point to [0, x] x [0, y] of the plane at distance 1 before it, across its normal (Lambert's formula for a
/// corner):
///
///   F = 1/(2 pi) [ x/sqrt(1+x²) atan(y/sqrt(1+x²)) + y/sqrt(1+y²) atan(x/sqrt(1+y²)) ]
///
/// @return in (-1/4, 1/4), odd in x and in y; pi is inside.  Test: tests/fem/hemicube_sight.cpp
double factor_across(double x, double y);

/// F from a point to [0, y] x [0, z] of a plane at distance 1 beside it, z along its normal:
///
///   F = 1/(2 pi) [ atan(y) - atan(y/sqrt(1+z²))/sqrt(1+z²) ]
///
/// @return in (-1/4, 1/4), odd in y; pi is inside.
double factor_beside(double y, double z);

/// The cells of a hemicube: a top, |x|, |y| <= 1 / height at distance 1, and four sides alike, |x| <= 1, 0 <= y <=
/// height.
///
/// Weights are exact integrals (differences of `factor_across` and `factor_beside` at the corners), which sum to 1 but
/// for rounding; or, as [Cohen, Greenberg 1985] have them, dF at the sample times the cell's area:
///
///   top dx dy / (pi (x²+y²+1)²),   side z dy dz / (pi (y²+z²+1)²)
struct HemicubeGrid {
  double height = 1;  ///< of the cube, over half its width
  FaceGrid top, side;

  /// The classical one: resolution x resolution equal cells on top, resolution x resolution / 2 on each side.
  /// @param resolution  even, at least 2   @throws core::PreconditionError
  static HemicubeGrid uniform(int resolution, CellWeights weights = CellWeights::exact);
  /// As many cells as that, rows and columns of each face of equal form factor: what optimised cells are compared with.
  static HemicubeGrid equal_factor(int resolution);
  /// Exact weights for any cells.
  static HemicubeGrid of(double height, CellAxis top_x, CellAxis top_y, CellAxis side_x, CellAxis side_y);

  int cells() const { return static_cast<int>(top.weight.size() + 4 * side.weight.size()); }
  double sum() const { return top.sum() + 4 * side.sum(); }
};

}  // namespace interflect::fem

#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "core/vec.h"

namespace interflect::scene {

/// A parallelogram of points at the centres of its cells.
struct SensorGrid {
  Vec3 origin, u, v;                          ///< corner and sides [m]
  std::variant<double, Eigen::Array2i> step;  ///< spacing [m], or counts along u and v; NaN spacing: by EN 12464-1
  double exclude_border = 0;                  ///< strip left out along all four sides [m]
};

/// Cells along u and v of what the border leaves of a grid: as given, or length / spacing, rounded.  Spacing by
/// EN 12464-1, 4.4: p = 0.2 * 5^(log10 d) m, at most 10 m, where d is the longer side (the shorter where their ratio is
/// 2 or more).
/// @return  each in 1 .. 1e9, so that their product is a number too, whatever a slip in the spacing asks for
std::array<std::int64_t, 2> cell_counts(const SensorGrid& grid);

/// Irradiance (illuminance) is asked at these points, for the hemisphere of `normal`.
struct Sensor {
  std::string name;
  Vec3 normal;
  std::variant<std::vector<Vec3>, SensorGrid> where;
};

/// What a scene file says a sensor should read.
struct Expected {
  enum class Statistic { mean, min, max };
  std::string sensor;
  Statistic statistic = Statistic::mean;
  double value = 0;      ///< [W/m² | lx]
  double tolerance = 0;  ///< relative
  std::string source;
};

}  // namespace interflect::scene

#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/vec.h"

namespace interflect::scene {

/// A parallelogram of points at cell centres; `measure/sensor_points.h` says how many.
struct SensorGrid {
  Vec3 origin, u, v;                          ///< corner and sides [m]
  std::variant<double, Eigen::Array2i> step;  ///< spacing [m], or counts along u and v; NaN spacing: by EN 12464-1
  double exclude_border = 0;                  ///< strip left out along all four sides [m]
};

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

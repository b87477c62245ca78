#pragma once

#include <string>
#include <vector>

#include "measure/measurement.h"
#include "scene/scene.h"

namespace interflect::measure {

struct SensorPoint {
  std::string sensor;
  int index;  ///< within its sensor
  PointIrradiance at;
};

/// Every point of every sensor, in the order of the file.  A point on a surface (within 1e-9 of the scene's diagonal,
/// its normal along the surface's on either side) is moved onto it and asked on that side.
std::vector<SensorPoint> sensor_points(const scene::Scene& scene);

/// Points at the centres of the grid's cells, along u first.  Spacing by EN 12464-1, 4.4: p = 0.2 * 5^(log10 d) m, at
/// most 10 m, where d is the longer side (the shorter where their ratio is 2 or more); counts are rounded.
std::vector<Vec3> grid_points(const scene::SensorGrid& grid);

}  // namespace interflect::measure

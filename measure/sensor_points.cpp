#include "measure/sensor_points.h"

#include <cmath>

#include "core/error.h"

namespace interflect::measure {
namespace {

constexpr double on_surface_tolerance = 1e-9;  ///< of the scene's diagonal
constexpr double parallel_tolerance = 1e-6;    ///< of 1 - |cos| between the normals

/// Is `x`, of a facet's plane, inside the facet or on its edge?
bool covers(const scene::Facet& facet, const Vec3& x, double tolerance) {
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 edge = facet.corner[(k + 1) % 3] - facet.corner[k];
    if (facet.normal.dot(edge.cross(x - facet.corner[k])) < -tolerance * edge.norm()) return false;
  }
  return true;
}

/// The point as it is asked: moved onto the plane of the facet that it lies on, if it lies on one, so that no method
/// starts below the surface because a file gives coordinates to nine digits.
PointIrradiance placed(const scene::Scene& scene, const Vec3& x, const Vec3& normal, double tolerance) {
  for (const scene::Facet& facet : scene.facets) {
    const double height = facet.normal.dot(x - facet.corner[0]);
    if (std::abs(height) > tolerance) continue;
    if (1 - std::abs(facet.normal.dot(normal)) > parallel_tolerance) continue;
    if (covers(facet, x, tolerance)) return {x - height * facet.normal, normal, facet.surface};
  }
  return {x, normal, std::nullopt};
}

}  // namespace

std::vector<Vec3> grid_points(const scene::SensorGrid& grid) {
  const double border = grid.exclude_border;
  const double full_u = grid.u.norm(), full_v = grid.v.norm();
  const double length_u = full_u - 2 * border, length_v = full_v - 2 * border;
  if (!(length_u > 0) || !(length_v > 0)) throw core::InputError("sensor grid", "exclude_border leaves nothing of it");
  const auto [along_u, along_v] = scene::cell_counts(grid);
  std::vector<Vec3> points;
  points.reserve(static_cast<std::size_t>(along_u * along_v));
  for (std::int64_t j = 0; j < along_v; ++j)
    for (std::int64_t i = 0; i < along_u; ++i)
      points.push_back(grid.origin + grid.u * ((border + (i + 0.5) * length_u / along_u) / full_u) +
                       grid.v * ((border + (j + 0.5) * length_v / along_v) / full_v));
  return points;
}

std::vector<SensorPoint> sensor_points(const scene::Scene& scene) {
  const double tolerance = on_surface_tolerance * scene.box().diagonal().norm();
  std::vector<SensorPoint> points;
  for (const scene::Sensor& sensor : scene.sensors) {
    const auto* grid = std::get_if<scene::SensorGrid>(&sensor.where);
    const std::vector<Vec3> positions =
        grid != nullptr ? grid_points(*grid) : std::get<std::vector<Vec3>>(sensor.where);
    int index = 0;
    for (const Vec3& x : positions)
      points.push_back({sensor.name, index++, placed(scene, x, sensor.normal, tolerance)});
  }
  return points;
}

}  // namespace interflect::measure

#include "measure/sensor_points.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace interflect::measure {
namespace {

constexpr double on_surface_tolerance = 1e-9;  ///< of the scene's diagonal
constexpr double parallel_tolerance = 1e-6;    ///< of 1 - |cos| between the normals

double spacing_of_en12464(double longer, double shorter) {
  const double d = longer >= 2 * shorter ? shorter : longer;
  return std::min(10.0, 0.2 * std::pow(5.0, std::log10(d)));
}

/// Is `x`, of a facet's plane, inside the facet or on its edge?
bool covers(const scene::Facet& facet, const Vec3& x, double tolerance) {
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 edge = facet.corner[(k + 1) % 3] - facet.corner[k];
    if (facet.normal.dot(edge.cross(x - facet.corner[k])) < -tolerance * edge.norm()) return false;
  }
  return true;
}

std::optional<scene::SurfaceId> surface_under(const scene::Scene& scene, const Vec3& x, const Vec3& normal, double tolerance) {
  for (const scene::Facet& facet : scene.facets) {
    if (std::abs(facet.normal.dot(x - facet.corner[0])) > tolerance) continue;
    if (1 - std::abs(facet.normal.dot(normal)) > parallel_tolerance) continue;
    if (covers(facet, x, tolerance)) return facet.surface;
  }
  return std::nullopt;
}

}  // namespace

std::vector<Vec3> grid_points(const scene::SensorGrid& grid) {
  const double border = grid.exclude_border;
  const double full_u = grid.u.norm(), full_v = grid.v.norm();
  const double length_u = full_u - 2 * border, length_v = full_v - 2 * border;
  if (!(length_u > 0) || !(length_v > 0)) throw core::InputError("sensor grid", "exclude_border leaves nothing of it");
  Eigen::Array2i counts;
  if (const auto* given = std::get_if<Eigen::Array2i>(&grid.step)) {
    counts = *given;
  } else {
    double p = std::get<double>(grid.step);
    if (std::isnan(p)) p = spacing_of_en12464(std::max(length_u, length_v), std::min(length_u, length_v));
    const auto cells = [p](double length) { return std::max(1, static_cast<int>(std::lround(length / p))); };
    counts = {cells(length_u), cells(length_v)};
  }
  std::vector<Vec3> points;
  points.reserve(static_cast<std::size_t>(counts[0]) * static_cast<std::size_t>(counts[1]));
  for (int j = 0; j < counts[1]; ++j)
    for (int i = 0; i < counts[0]; ++i)
      points.push_back(grid.origin + grid.u * ((border + (i + 0.5) * length_u / counts[0]) / full_u) +
                       grid.v * ((border + (j + 0.5) * length_v / counts[1]) / full_v));
  return points;
}

std::vector<SensorPoint> sensor_points(const scene::Scene& scene) {
  const double tolerance = on_surface_tolerance * scene.box().diagonal().norm();
  std::vector<SensorPoint> points;
  for (const scene::Sensor& sensor : scene.sensors) {
    const auto* grid = std::get_if<scene::SensorGrid>(&sensor.where);
    const std::vector<Vec3> positions = grid != nullptr ? grid_points(*grid) : std::get<std::vector<Vec3>>(sensor.where);
    int index = 0;
    for (const Vec3& x : positions)
      points.push_back({sensor.name, index++, {x, sensor.normal, surface_under(scene, x, sensor.normal, tolerance)}});
  }
  return points;
}

}  // namespace interflect::measure

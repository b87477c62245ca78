#include "geometry/polygon.h"

#include <algorithm>
#include <cmath>

#include "geometry/box.h"

namespace interflect::geometry {
namespace {

Vec3 mean_of(std::span<const Vec3> ring) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& x : ring) sum += x - ring.front();
  return ring.front() + sum / static_cast<double>(ring.size());
}

}  // namespace

Box box_of(std::span<const Vec3> points) {
  Box box;
  for (const Vec3& x : points) box.extend(x);
  return box;
}

Vec3 vector_area(std::span<const Vec3> ring) {
  Vec3 twice = Vec3::Zero();
  for (std::size_t k = 1; k + 1 < ring.size(); ++k) twice += (ring[k] - ring[0]).cross(ring[k + 1] - ring[0]);
  return 0.5 * twice;
}

double area(const PlanarPolygon& polygon) {
  double sum = vector_area(polygon.outer).norm();
  for (const Ring& hole : polygon.holes) sum -= vector_area(hole).norm();
  return sum;
}

Plane plane_of(std::span<const Vec3> ring) {
  const Vec3 normal = vector_area(ring);
  const double length = normal.norm();
  if (!(length > 0) || !std::isfinite(length)) throw Defect("the polygon has no area");
  const Vec3 unit = normal / length;
  return {unit, unit.dot(mean_of(ring))};
}

LocalPlane local_plane_of(std::span<const Vec3> ring) { return {plane_of(ring).normal, mean_of(ring)}; }

double relative_planarity_error(const PlanarPolygon& polygon) {
  const LocalPlane plane = local_plane_of(polygon.outer);
  double largest = 0;
  const auto add = [&](const Ring& ring) {
    for (const Vec3& x : ring) largest = std::max(largest, std::abs(plane.distance(x)));
  };
  add(polygon.outer);
  for (const Ring& hole : polygon.holes) add(hole);
  return largest / box_of(polygon.outer).diagonal().norm();
}

}  // namespace interflect::geometry

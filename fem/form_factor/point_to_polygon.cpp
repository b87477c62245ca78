#include "fem/form_factor/point_to_polygon.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "geometry/clip.h"

namespace interflect::fem {

namespace {

constexpr std::size_t most_corners = 8;

/// One edge's term, times 2 pi: n . (r x e) theta / |r x e|.  On the edge itself the term has no direction and is left
/// out.
double edge_term(const Vec3& n, const Vec3& from, const Vec3& to, const Vec3& edge) {
  const Vec3 normal = from.cross(edge);
  const double cross = normal.norm();
  return cross > 0.0 ? n.dot(normal) * std::atan2(cross, from.dot(to)) / cross : 0.0;
}

}  // namespace

double point_to_polygon_above_horizon(const Vec3& x, const Vec3& n, std::span<const Vec3> polygon) {
  double sum = 0.0;
  const std::size_t corners = polygon.size();
  for (std::size_t k = 0; k < corners; ++k) {
    const Vec3 &p = polygon[k], &q = polygon[k + 1 < corners ? k + 1 : 0];
    sum += edge_term(n, p - x, q - x, q - p);
  }
  return std::min(1.0, std::abs(sum) * (0.5 * inv_pi));
}

double point_to_polygon(const Vec3& x, const Vec3& n, std::span<const Vec3> polygon) {
  if (polygon.size() > most_corners) throw core::PreconditionError("point_to_polygon: at most 8 corners expected");
  double lowest = 0.0, highest = 0.0;
  for (const Vec3& p : polygon) {
    const double height = n.dot(p - x);
    lowest = std::min(lowest, height);
    highest = std::max(highest, height);
  }
  if (highest <= 0.0) return 0.0;
  if (lowest >= 0.0) return point_to_polygon_above_horizon(x, n, polygon);
  geometry::ConvexRing relative;  // to x, so that the clip loses nothing where coordinates are large
  for (const Vec3& p : polygon) relative.corner[static_cast<std::size_t>(relative.corners++)] = p - x;
  return point_to_polygon_above_horizon(Vec3::Zero(), n, geometry::clip(relative.ring(), {n, 0.0}).ring());
}

double point_to_polygon_far(const Vec3& x, const Vec3& n, const Vec3& centroid, const Vec3& polygon_normal,
                            double area) {
  const Vec3 to = centroid - x;
  const double receives = n.dot(to), sends = -polygon_normal.dot(to);
  if (receives <= 0.0 || sends <= 0.0) return 0.0;
  const double square = to.squaredNorm();
  return area * receives * sends * inv_pi / (square * square);
}

}  // namespace interflect::fem

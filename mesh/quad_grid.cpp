#include "mesh/quad_grid.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace interflect::mesh {
namespace {

constexpr double smallest_sine = 0.05;  // of a corner's angle: 3 degrees

bool clearly_convex(const geometry::Ring& ring) {
  const Vec3 normal = geometry::vector_area(ring).normalized();
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec3 in = ring[k] - ring[(k + 3) % 4], out = ring[(k + 1) % 4] - ring[k];
    if (!(normal.dot(in.cross(out)) > smallest_sine * in.norm() * out.norm())) return false;
  }
  return true;
}

/// Cells for a side, with room for the rounding of a length that is a multiple of the edge.
double cells(double length, double max_edge) { return std::max(1.0, std::ceil(length / max_edge * (1 - 1e-12))); }

/// Cells along the sides 0-1 and 1-2, as doubles: no integer holds what a slip in an element size asks for.
struct Cells {
  double u, v;
};

std::optional<Cells> cells_of(const scene::Surface& surface, double max_edge) {
  if (!surface.outline || surface.outline->outer.size() != 4 || !surface.outline->holes.empty()) return std::nullopt;
  const geometry::Ring& ring = surface.outline->outer;
  if (!clearly_convex(ring)) return std::nullopt;
  const double along_u = std::max((ring[1] - ring[0]).norm(), (ring[2] - ring[3]).norm());
  const double along_v = std::max((ring[2] - ring[1]).norm(), (ring[3] - ring[0]).norm());
  return Cells{cells(along_u, max_edge), cells(along_v, max_edge)};
}

}  // namespace

Vec3 QuadGrid::point(std::uint32_t i, std::uint32_t j) const {
  // Each point from the nearest corner's side: corners and points on sides come out exactly, opposite sides alike.
  const double s = static_cast<double>(i) / nu, t = static_cast<double>(j) / nv;
  const auto between = [](const Vec3& a, const Vec3& b, double w) -> Vec3 {
    return w <= 0.5 ? Vec3(a + w * (b - a)) : Vec3(b + (1 - w) * (a - b));
  };
  return between(between(corner[0], corner[1], s), between(corner[3], corner[2], s), t);
}

std::optional<QuadGrid> quad_grid(const scene::Surface& surface, double max_edge) {
  const auto count = cells_of(surface, max_edge);
  if (!count) return std::nullopt;
  if (!(count->u * count->v <= 0x1p31)) throw core::PreconditionError("quad_grid: more than 2^31 cells");
  const geometry::Ring& ring = surface.outline->outer;
  return QuadGrid{
      {ring[0], ring[1], ring[2], ring[3]}, static_cast<std::uint32_t>(count->u), static_cast<std::uint32_t>(count->v)};
}

std::optional<double> quad_grid_cells(const scene::Surface& surface, double max_edge) {
  const auto count = cells_of(surface, max_edge);
  return count ? std::optional(count->u * count->v) : std::nullopt;
}

}  // namespace interflect::mesh

#include "mesh/element_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/format.h"

namespace interflect::mesh {
namespace {

using scene::SurfacePatch;

/// Position among all parts: by surface, fronts before backs.
std::pair<scene::SurfaceId, scene::Side> key(const auto& of) { return {of.surface, of.side}; }

double clamped(double x) { return std::clamp(x, 0.0, 1.0); }

struct Coordinates {
  double u, v;
};

/// Barycentric, of the nearest point of the triangle.
Coordinates in_triangle(const SurfacePatch& p, const Vec3& x) {
  const Vec3 a = p.corner[1] - p.corner[0], b = p.corner[2] - p.corner[0], d = x - p.corner[0];
  const Vec3 n = a.cross(b);
  const double scale = 1 / n.squaredNorm(), u = d.cross(b).dot(n) * scale, v = a.cross(d).dot(n) * scale;
  if (u >= 0 && v >= 0 && u + v <= 1) return {u, v};
  const auto along = [](const Vec3& edge, const Vec3& from_start) {
    return clamped(edge.dot(from_start) / edge.squaredNorm());
  };
  const double on_a = along(a, d), on_b = along(b, d), on_c = along(b - a, d - a);
  const std::array<Coordinates, 3> nearest{{{on_a, 0}, {0, on_b}, {1 - on_c, on_c}}};
  return *std::min_element(nearest.begin(), nearest.end(), [&](const Coordinates& s, const Coordinates& t) {
    return (s.u * a + s.v * b - d).squaredNorm() < (t.u * a + t.v * b - d).squaredNorm();
  });
}

/// Bilinear: d = u a + v b + u v c, solved for v first, each clamped to [0, 1].
///
/// (d - v b) x (a + v c) = 0 is a quadratic in v; the root that stays finite as c -> 0 (a parallelogram) is the one
/// inside a convex quad, where the square root of the discriminant is the Jacobian of the map.
Coordinates in_quad(const SurfacePatch& p, const Vec3& x) {
  const Vec3 a = p.corner[1] - p.corner[0], b = p.corner[3] - p.corner[0], c = p.corner[2] - p.corner[3] - a,
             d = x - p.corner[0];
  const Vec3 n = (p.corner[2] - p.corner[0]).cross(p.corner[3] - p.corner[1]).normalized();
  const auto cross = [&](const Vec3& s, const Vec3& t) { return n.dot(s.cross(t)); };
  const double A = -cross(b, c), B = cross(d, c) + cross(a, b), C = cross(d, a);
  const double root = B + std::sqrt(std::max(0.0, B * B - 4 * A * C));
  const double v = clamped(root > 0 ? -2 * C / root : (A != 0 ? -B / (2 * A) : 0.5));
  const Vec3 along = a + v * c;
  return {clamped(along.dot(d - v * b) / along.squaredNorm()), v};
}

Vec3 position_at(const SurfacePatch& p, const ElementPoint& at) {
  const auto& c = p.corner;
  if (p.corners == 3) return c[0] + at.u * (c[1] - c[0]) + at.v * (c[2] - c[0]);
  return c[0] + at.u * (c[1] - c[0]) + at.v * (c[3] - c[0]) + at.u * at.v * (c[2] - c[3] - c[1] + c[0]);
}

void require_area(const SurfacePatch& patch) {
  const Vec3& x = patch.corner[0];
  if (!(patch.area > 0))
    throw core::InputError(core::format(
        "the element at (%.10g, %.10g, %.10g) has no area: its coordinates do not resolve it", x.x(), x.y(), x.z()));
}

}  // namespace

double longest_edge(const SurfacePatch& patch) {
  double longest = 0;
  for (std::size_t k = 0; k < patch.corners; ++k)
    longest = std::max(longest, (patch.corner[(k + 1) % patch.corners] - patch.corner[k]).norm());
  return longest;
}

ElementMesh::ElementMesh(std::vector<SurfacePatch> patches) : patches_(std::move(patches)) {
  if (patches_.size() > std::numeric_limits<std::uint32_t>::max()) throw core::InputError("more than 2^32 elements");
  std::vector<geometry::Box> boxes(patches_.size());
  for (std::uint32_t i = 0; i < patches_.size(); ++i) {
    const SurfacePatch& patch = patches_[i];
    require_area(patch);
    boxes[i] = geometry::box_of(patch.ring());
    longest_edge_ = std::max(longest_edge_, mesh::longest_edge(patch));
    if (parts_.empty() || key(parts_.back()) != key(patch)) {
      if (!parts_.empty() && key(patch) < key(parts_.back()))
        throw core::PreconditionError("elements must come surface after surface, fronts before backs");
      parts_.push_back({patch.surface, patch.side, i, 0});
    }
    ++parts_.back().count;
  }
  for (const Part& part : parts_) trees_.emplace_back(std::span(boxes).subspan(part.first, part.count));
}

std::optional<ElementPoint> ElementMesh::locate(const scene::SurfacePoint& point) const {
  const auto before = [](const Part& part, const scene::SurfacePoint& x) { return key(part) < key(x); };
  const auto part = std::lower_bound(parts_.begin(), parts_.end(), point, before);
  if (part == parts_.end() || key(*part) != key(point)) return std::nullopt;

  // The nearest element, which is the one that holds the point up to rounding; the first of several that are equally
  // near.
  std::optional<ElementPoint> nearest;
  double least = std::numeric_limits<double>::infinity();
  const auto near_enough = [&](const geometry::Box& box) {
    return box.squaredExteriorDistance(point.position) <= least;
  };
  const auto compare = [&](std::uint32_t item) {
    const ElementId id{part->first + item};
    const ElementPoint at = coordinates_in(patch(id), id, point.position);
    const double distance = (position_at(patch(id), at) - point.position).squaredNorm();
    if (distance < least || (distance == least && id < nearest->element)) nearest = at, least = distance;
  };
  trees_[static_cast<std::size_t>(part - parts_.begin())].traverse(near_enough, compare);
  return nearest;
}

ElementPoint coordinates_in(const SurfacePatch& patch, ElementId id, const Vec3& position) {
  const auto [u, v] = patch.corners == 3 ? in_triangle(patch, position) : in_quad(patch, position);
  return {id, u, v};
}

}  // namespace interflect::mesh

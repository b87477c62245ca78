#include "fem/bounds/facet_cells.h"

#include <algorithm>
#include <cmath>

#include "geometry/box_tree.h"

namespace interflect::fem {
namespace {

using Triangle = std::array<Vec3, 3>;

struct Stretch {
  Vec3 from, to;
  double length() const { return (to - from).norm(); }
};

/// Twice the area over the longest side.
double height_of(const Triangle& t) {
  double longest = 0;
  for (std::size_t k = 0; k < 3; ++k) longest = std::max(longest, (t[(k + 1) % 3] - t[k]).norm());
  return longest > 0 ? (t[1] - t[0]).cross(t[2] - t[0]).norm() / longest : 0;
}
Vec3 normal_of(const Triangle& t) { return (t[1] - t[0]).cross(t[2] - t[0]).normalized(); }

/// Where a triangle meets a plane, in stretches; its three edges if it lies in it.
void append_meeting(const Triangle& t, const Vec3& on_plane, const Vec3& normal, double tolerance,
                    std::vector<Stretch>& out) {
  std::array<double, 3> height;
  for (std::size_t k = 0; k < 3; ++k) {
    height[k] = normal.dot(t[k] - on_plane);
    if (std::abs(height[k]) <= tolerance) height[k] = 0;
  }
  const auto in_plane = std::count(height.begin(), height.end(), 0.0);
  std::array<Vec3, 2> end;
  std::size_t ends = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    if (height[k] == 0 && height[next] == 0) {
      out.push_back({t[k], t[next]});
    } else if (in_plane < 2) {
      if (height[k] == 0) end[ends++] = t[k];
      if (height[k] * height[next] < 0)
        end[ends++] = t[k] + (height[k] / (height[k] - height[next])) * (t[next] - t[k]);
    }
  }
  if (ends == 2) out.push_back({end[0], end[1]});
}

/// How much of a stretch lies within a convex polygon of its plane, further from the edges than the tolerance.
double length_within(const Stretch& s, const FacetCell& cell, double tolerance) {
  double begin = 0, end = 1;
  for (std::size_t k = 0; k < cell.ring.size(); ++k) {
    const Vec3& corner = cell.ring[k];
    const Vec3 inward = cell.normal.cross(cell.ring[(k + 1) % cell.ring.size()] - corner).normalized();
    const double from = inward.dot(s.from - corner) - tolerance, to = inward.dot(s.to - corner) - tolerance;
    if (from <= 0 && to <= 0) return 0;
    if (from < 0) begin = std::max(begin, from / (from - to));
    if (to < 0) end = std::min(end, from / (from - to));
  }
  return std::max(0.0, end - begin) * s.length();
}

/// The two parts of a convex polygon on either side of a line.
std::array<FacetCell, 2> cut(const FacetCell& cell, const Stretch& along, double tolerance) {
  const Vec3 aside = cell.normal.cross(along.to - along.from).normalized();
  std::array<FacetCell, 2> parts{FacetCell{cell.facet, cell.normal, {}}, FacetCell{cell.facet, cell.normal, {}}};
  const auto distance = [&](const Vec3& x) {
    const double d = aside.dot(x - along.from);
    return std::abs(d) <= tolerance ? 0 : d;
  };
  for (std::size_t k = 0; k < cell.ring.size(); ++k) {
    const Vec3 &x = cell.ring[k], &next = cell.ring[(k + 1) % cell.ring.size()];
    const double here = distance(x), there = distance(next);
    if (here >= 0) parts[0].ring.push_back(x);
    if (here <= 0) parts[1].ring.push_back(x);
    if (here * there < 0) {
      const Vec3 between = x + (here / (here - there)) * (next - x);
      for (FacetCell& part : parts) part.ring.push_back(between);
    }
  }
  return parts;
}

/// Cuts a cell by all stretches that run through it, and its parts.
/// @return  whether no more than `most` cells came of it
bool append_parts(FacetCell whole, std::vector<Stretch> through, double tolerance, std::size_t most,
                  std::vector<FacetCell>& out) {
  struct Task {
    FacetCell cell;
    std::vector<Stretch> through;
  };
  std::vector<Task> tasks;
  tasks.push_back({std::move(whole), std::move(through)});
  while (!tasks.empty()) {
    Task task = std::move(tasks.back());
    tasks.pop_back();
    std::erase_if(task.through, [&](const Stretch& s) { return length_within(s, task.cell, tolerance) <= tolerance; });
    if (task.through.empty()) {
      out.push_back(std::move(task.cell));
      continue;
    }
    if (out.size() + tasks.size() + 2 > most) return false;
    const Stretch longest =
        *std::max_element(task.through.begin(), task.through.end(),
                          [](const Stretch& a, const Stretch& b) { return a.length() < b.length(); });
    for (FacetCell& part : cut(task.cell, longest, tolerance)) tasks.push_back({std::move(part), task.through});
  }
  return true;
}

geometry::Box around(const Triangle& t, double margin) {
  const geometry::Box box = geometry::box_of(t);
  return {box.min().array() - margin, box.max().array() + margin};
}

}  // namespace

std::optional<std::vector<FacetCell>> facet_cells(std::span<const Triangle> triangles, double tolerance,
                                                  std::size_t most) {
  std::vector<geometry::Box> boxes;
  for (const Triangle& t : triangles) boxes.push_back(around(t, tolerance));
  const geometry::BoxTree tree(boxes);
  std::vector<FacetCell> cells;
  for (std::uint32_t f = 0; f < triangles.size(); ++f) {
    const Triangle& t = triangles[f];
    if (height_of(t) <= tolerance) continue;
    const Vec3 normal = normal_of(t);
    std::vector<Stretch> contacts;
    tree.traverse([&](const geometry::Box& box) { return box.intersects(boxes[f]); },
                  [&](std::uint32_t g) {
                    if (g != f && boxes[g].intersects(boxes[f]))
                      append_meeting(triangles[g], t[0], normal, tolerance, contacts);
                  });
    if (!append_parts({f, normal, {t.begin(), t.end()}}, std::move(contacts), tolerance, most, cells))
      return std::nullopt;
  }
  return cells;
}

}  // namespace interflect::fem

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/format.h"
#include "geometry/box_tree.h"
#include "geometry/plane_coordinates.h"
#include "geometry/point_in_ring.h"
#include "geometry/polygon.h"

namespace interflect::geometry {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_2;

/// Area over the squared diameter below which a ring counts as a line.
constexpr double flatness = 1e-12;

std::string name_of(std::size_t ring) { return ring == 0 ? "the outline" : core::format("hole %zu", ring - 1); }

struct Edge {
  std::size_t ring, corner;  ///< ring 0 is the outer one
  Point from, to;
};

/// All rings in their plane, for exact questions.
struct Shadow {
  std::vector<std::vector<Vec2>> rings;
  std::vector<Edge> edges;

  explicit Shadow(const PlanarPolygon& polygon) {
    const AxisShadow shadow(vector_area(polygon.outer));
    const auto add = [&](const Ring& ring) {
      std::vector<Vec2> points;
      for (const Vec3& r : ring) points.push_back(shadow(r));
      const auto point = [&](std::size_t k) { return Point(points[k].x(), points[k].y()); };
      for (std::size_t k = 0; k < points.size(); ++k)
        edges.push_back({rings.size(), k, point(k), point((k + 1) % points.size())});
      rings.push_back(std::move(points));
    };
    add(polygon.outer);
    for (const Ring& hole : polygon.holes) add(hole);
  }

  std::size_t next(const Edge& e) const { return (e.corner + 1) % rings[e.ring].size(); }
};

/// Two edges in a row may only share their corner: no spike that runs back on itself.
bool runs_back(const Point& a, const Point& b, const Point& c) {
  return CGAL::collinear(a, b, c) && !CGAL::collinear_are_strictly_ordered_along_line(a, b, c);
}

/// Whether point p of the line through a, b lies between them, ends included.
bool within(const Point& a, const Point& b, const Point& p) {
  return std::min(a.x(), b.x()) <= p.x() && p.x() <= std::max(a.x(), b.x()) && std::min(a.y(), b.y()) <= p.y() &&
         p.y() <= std::max(a.y(), b.y());
}

/// Whether two closed segments share a point, by the signs of four orientations.
bool segments_meet(const Edge& e, const Edge& f) {
  const int a = CGAL::orientation(e.from, e.to, f.from), b = CGAL::orientation(e.from, e.to, f.to);
  const int c = CGAL::orientation(f.from, f.to, e.from), d = CGAL::orientation(f.from, f.to, e.to);
  if (a * b < 0 && c * d < 0) return true;
  return (a == 0 && within(e.from, e.to, f.from)) || (b == 0 && within(e.from, e.to, f.to)) ||
         (c == 0 && within(f.from, f.to, e.from)) || (d == 0 && within(f.from, f.to, e.to));
}

bool in_conflict(const Shadow& shadow, const Edge& e, const Edge& f) {
  if (e.ring == f.ring && shadow.next(e) == f.corner) return runs_back(e.from, e.to, f.to);
  if (e.ring == f.ring && shadow.next(f) == e.corner) return runs_back(f.from, f.to, e.to);
  return segments_meet(e, f);
}

Box flat_box(const Edge& e) {
  Box box(Vec3(e.from.x(), e.from.y(), 0));
  return box.extend(Vec3(e.to.x(), e.to.y(), 0));
}

void require_no_crossing(const Shadow& shadow) {
  std::vector<Box> boxes;
  for (const Edge& e : shadow.edges) boxes.push_back(flat_box(e));
  const BoxTree tree(boxes);
  for (std::size_t i = 0; i < shadow.edges.size(); ++i) {
    std::optional<std::size_t> met;
    tree.traverse([&](const Box& box) { return box.intersects(boxes[i]); },
                  [&](std::uint32_t j) {
                    if (j > i && in_conflict(shadow, shadow.edges[i], shadow.edges[j]))
                      met = std::min<std::size_t>(met.value_or(j), j);
                  });
    if (!met) continue;
    const Edge &e = shadow.edges[i], &f = shadow.edges[*met];
    if (e.ring == f.ring)
      throw Defect(core::format("%s crosses or touches itself: the edges after corners %zu and %zu meet",
                                name_of(e.ring).c_str(), e.corner, f.corner));
    throw Defect(core::format("%s touches or crosses %s", name_of(e.ring).c_str(), name_of(f.ring).c_str()));
  }
}

void require_nesting(const Shadow& shadow) {
  for (std::size_t i = 1; i < shadow.rings.size(); ++i) {
    if (!encloses(shadow.rings[0], shadow.rings[i][0])) throw Defect(name_of(i) + " is not inside the outline");
    for (std::size_t j = 1; j < shadow.rings.size(); ++j)
      if (j != i && encloses(shadow.rings[j], shadow.rings[i][0]))
        throw Defect(name_of(i) + " lies inside " + name_of(j));
  }
}

void require_ring(const Ring& ring, std::size_t number) {
  const std::string name = name_of(number);
  if (ring.size() < 3) throw Defect(core::format("%s has %zu corners: at least 3 expected", name.c_str(), ring.size()));
  for (std::size_t k = 0; k < ring.size(); ++k)
    if (!ring[k].allFinite()) throw Defect(core::format("corner %zu of %s is not finite", k, name.c_str()));
  for (std::size_t k = 0; k < ring.size(); ++k)
    if (ring[k] == ring[(k + 1) % ring.size()])
      throw Defect(core::format("corners %zu and %zu of %s coincide", k, (k + 1) % ring.size(), name.c_str()));
  const double diameter = box_of(ring).diagonal().norm();
  if (!(vector_area(ring).norm() > flatness * diameter * diameter))
    throw Defect(name + " encloses no area: its corners lie on a line, or it crosses itself");
}

}  // namespace

void require_valid(const PlanarPolygon& polygon) {
  require_ring(polygon.outer, 0);
  for (std::size_t h = 0; h < polygon.holes.size(); ++h) require_ring(polygon.holes[h], h + 1);
  const double error = relative_planarity_error(polygon);
  if (!(error <= planarity_tolerance))
    throw Defect(core::format(
        "the polygon is not planar: a corner lies %.3g of its diameter out of plane, at most %.0e is allowed", error,
        planarity_tolerance));
  const Shadow shadow(polygon);
  require_no_crossing(shadow);
  require_nesting(shadow);
}

}  // namespace interflect::geometry

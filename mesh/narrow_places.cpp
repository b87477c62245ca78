#include "mesh/narrow_places.h"

#include <algorithm>
#include <cmath>

#include "geometry/box_tree.h"

namespace interflect::mesh {
namespace {

constexpr double triangles_a_side = 0.6;  // of a strip as long as it is wide, to each of its two sides
constexpr int deepest = 12;               // halvings of an edge

struct Edge {
  std::size_t ring, corner, next;
  Vec3 from, to;

  bool touches(const Edge& o) const {
    return ring == o.ring && (corner == o.corner || corner == o.next || next == o.corner);
  }
  double distance(const Vec3& x) const {
    const Vec3 along = to - from;
    return (from + std::clamp(along.dot(x - from) / along.squaredNorm(), 0.0, 1.0) * along - x).norm();
  }
};

class Outline {
 public:
  Outline(const geometry::PlanarPolygon& polygon, double area_each)
      : area_each_(area_each), wide_(std::sqrt(2 * area_each * triangles_a_side)) {
    add(polygon.outer, 0);
    for (std::size_t h = 0; h < polygon.holes.size(); ++h) add(polygon.holes[h], h + 1);
    std::vector<geometry::Box> boxes;
    for (const Edge& edge : edges_) boxes.push_back(geometry::Box(edge.from).extend(edge.to));
    tree_ = geometry::BoxTree(boxes);
  }

  double triangles() const {
    double sum = 0;
    for (const Edge& edge : edges_) sum += beside(edge, edge.from, edge.to, 0);
    return sum;
  }

 private:
  void add(const geometry::Ring& ring, std::size_t number) {
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const std::size_t next = (k + 1) % ring.size();
      edges_.push_back({number, k, next, ring[k], ring[next]});
    }
  }

  /// Of a piece of an edge, halved until the distance to other edges, which varies no faster than the place, is known.
  double beside(const Edge& edge, const Vec3& a, const Vec3& b, int depth) const {
    const Vec3 middle = 0.5 * (a + b);
    const double length = (b - a).norm(), d = width_at(edge, middle, wide_ + 0.5 * length);
    if (d >= wide_ + 0.5 * length) return 0;
    if (length > d && depth < deepest) return beside(edge, a, middle, depth + 1) + beside(edge, middle, b, depth + 1);
    return d > 0 ? length * std::max(0.0, triangles_a_side / d - d / (2 * area_each_)) : 0;
  }

  /// Distance to the nearest edge that does not touch this one, at most `limit`.
  double width_at(const Edge& edge, const Vec3& x, double limit) const {
    tree_.traverse([&](const geometry::Box& box) { return box.squaredExteriorDistance(x) < limit * limit; },
                   [&](std::uint32_t other) {
                     if (!edge.touches(edges_[other])) limit = std::min(limit, edges_[other].distance(x));
                   });
    return limit;
  }

  double area_each_, wide_;  ///< [m²]; the width from which nothing is narrow [m]
  std::vector<Edge> edges_;
  geometry::BoxTree tree_;
};

}  // namespace

bool has_needle(const geometry::PlanarPolygon& polygon) {
  constexpr double sharpest = 0.0175;  // [rad]
  const geometry::Ring& ring = polygon.outer;
  const std::size_t n = ring.size();
  for (std::size_t k = 0; k < n; ++k) {
    const Vec3 to = ring[(k + 1) % n] - ring[k], from = ring[(k + n - 1) % n] - ring[k];
    if (to.dot(from) > 0 && to.cross(from).norm() < sharpest * to.dot(from)) return true;
  }
  return false;
}

double triangles_of_narrow_places(const geometry::PlanarPolygon& polygon, double area_each) {
  return Outline(polygon, area_each).triangles();
}

}  // namespace interflect::mesh

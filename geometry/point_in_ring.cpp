#include "geometry/point_in_ring.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

namespace interflect::geometry {

bool encloses(std::span<const Vec2> ring, const Vec2& p) {
  using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_2;
  const auto point = [](const Vec2& x) { return Point(x.x(), x.y()); };
  bool inside = false;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Vec2 &a = ring[k], &b = ring[(k + 1) % ring.size()];
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    // The edge is crossed if p lies on its -x side: left of an edge that runs up, right of one that runs down.
    const auto crossed = b.y() > a.y() ? CGAL::LEFT_TURN : CGAL::RIGHT_TURN;
    inside ^= CGAL::orientation(point(a), point(b), point(p)) == crossed;
  }
  return inside;
}

}  // namespace interflect::geometry

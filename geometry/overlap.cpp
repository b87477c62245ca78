#include "geometry/overlap.h"

#include <cassert>

#include "geometry/clip.h"

namespace interflect::geometry {

double overlap_area(std::span<const Vec3> a, std::span<const Vec3> b) {
  assert(a.size() + b.size() <= static_cast<std::size_t>(ConvexRing::capacity));
  const Vec3 normal = vector_area(b), &origin = b[0];
  ConvexRing left;
  for (const Vec3& x : a) left.corner[static_cast<std::size_t>(left.corners++)] = x - origin;
  for (std::size_t k = 0; k < b.size() && left.corners > 0; ++k) {
    const Vec3 from = b[k] - origin, to = b[(k + 1) % b.size()] - origin;
    const Vec3 inwards = normal.cross(to - from).normalized();
    left = clip(left.ring(), {inwards, inwards.dot(from)});
  }
  return left.corners > 0 ? vector_area(left.ring()).norm() : 0;
}

}  // namespace interflect::geometry

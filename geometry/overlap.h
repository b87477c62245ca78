#pragma once

#include "geometry/clip.h"
#include "geometry/triangulate.h"

namespace interflect::geometry {

/// Area that two triangles of one plane have in common [m²], whichever way they run: one is clipped to the sides of the other.
/// Accuracy: about 1e-15 of the product of their diameters.  Triangles of different planes: that of `a`'s part inside the prism
/// that stands on `b`.
inline double overlap_area(const TriangleCorners& a, const TriangleCorners& b) {
  const Vec3 normal = (b[1] - b[0]).cross(b[2] - b[0]);
  ConvexRing left;
  left.corners = 3;
  for (std::size_t k = 0; k < 3; ++k) left.corner[k] = a[k];
  for (std::size_t k = 0; k < 3 && left.corners > 0; ++k) {
    const Vec3 inwards = normal.cross(b[(k + 1) % 3] - b[k]).normalized();
    left = clip(left.ring(), {inwards, inwards.dot(b[k])});
  }
  return left.corners > 0 ? vector_area(left.ring()).norm() : 0;
}

}  // namespace interflect::geometry

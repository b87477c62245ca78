#pragma once

#include <algorithm>

#include "core/vec.h"

namespace interflect::geometry {

/// Of a point from a segment, whose ends may be one [m].
inline double distance_to_segment(const Vec3& x, const Vec3& from, const Vec3& to) {
  const Vec3 along = to - from;
  const double square = along.squaredNorm();
  const double t = square > 0 ? std::clamp(along.dot(x - from) / square, 0.0, 1.0) : 0;
  return (x - from - t * along).norm();
}

}  // namespace interflect::geometry

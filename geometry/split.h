#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "geometry/convex_blocker.h"

namespace interflect::geometry {

enum class HalfSide { inside, outside, across };

/// Where a ring lies; fills the corners' distances.  A ring in the boundary alone counts as outside: it has no part
/// within.
inline HalfSide side_of(std::span<const Vec3> ring, const HalfSpace& half, std::vector<double>& distance) {
  distance.resize(ring.size());
  double lowest = half.normal.dot(ring[0]) - half.offset, highest = lowest;
  distance[0] = lowest;
  for (std::size_t k = 1; k < ring.size(); ++k) {
    const double d = distance[k] = half.normal.dot(ring[k]) - half.offset;
    lowest = std::min(lowest, d);
    highest = std::max(highest, d);
  }
  if (highest <= 0) return HalfSide::outside;
  return lowest >= 0 ? HalfSide::inside : HalfSide::across;
}

/// Both parts of a ring that lies across; corners in the boundary belong to both.
inline void split(std::span<const Vec3> ring, std::span<const double> distance, std::vector<Vec3>& inside,
                  std::vector<Vec3>& outside) {
  inside.clear();
  outside.clear();
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const std::size_t next = k + 1 < ring.size() ? k + 1 : 0;
    if (distance[k] >= 0) inside.push_back(ring[k]);
    if (distance[k] <= 0) outside.push_back(ring[k]);
    if ((distance[k] > 0 && distance[next] < 0) || (distance[k] < 0 && distance[next] > 0)) {
      const Vec3 x = ring[k] + distance[k] / (distance[k] - distance[next]) * (ring[next] - ring[k]);
      inside.push_back(x);
      outside.push_back(x);
    }
  }
}

}  // namespace interflect::geometry

#pragma once

#include <cmath>
#include <vector>

#include "core/random.h"
#include "geometry/polygon.h"

namespace interflect::geometry::test {

/// Uniform numbers for shapes: one stream a case.
class Dice {
 public:
  explicit Dice(std::uint32_t stream) : numbers_(20240607, stream, 0) {}
  double in(double low, double high) { return low + (high - low) * numbers_.next(); }
  Vec3 point(double half) { return {in(-half, half), in(-half, half), in(-half, half)}; }
  Vec3 direction() {
    const double z = in(-1, 1), phi = in(0, 2 * pi), r = std::sqrt(1 - z * z);
    return {r * std::cos(phi), r * std::sin(phi), z};
  }

 private:
  core::RandomNumbers numbers_;
};

/// Any orthonormal pair across a direction: (u, v, n) is right-handed.
inline std::pair<Vec3, Vec3> frame(const Vec3& n) {
  const Vec3 u = n.unitOrthogonal();
  return {u, n.cross(u)};
}

/// A star-shaped (mostly concave) polygon around `centre`, counter-clockwise around `normal`.
inline Ring star(Dice& dice, int corners, const Vec3& centre, const Vec3& normal, double radius) {
  const auto [u, v] = frame(normal);
  Ring ring;
  for (int k = 0; k < corners; ++k) {
    const double phi = 2 * pi * (k + dice.in(0.1, 0.9)) / corners, r = radius * dice.in(0.4, 1.0);
    ring.push_back(centre + r * std::cos(phi) * u + r * std::sin(phi) * v);
  }
  return ring;
}

inline Ring rectangle(double x0, double y0, double x1, double y1, double z = 0) {
  return {{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}};
}

}  // namespace interflect::geometry::test

#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/random.h"
#include "core/vec.h"
#include "geometry/polygon.h"

/// Random pairs of triangles and quads that face each other.
namespace interflect::fem::test {

struct RingPair {
  geometry::Ring a, b;
};

inline Vec3 normal_of(const geometry::Ring& ring) { return geometry::vector_area(ring).normalized(); }
inline double area_of(const geometry::Ring& ring) { return geometry::vector_area(ring).norm(); }

/// How near two polygons are.
enum class Nearness { common_corner, common_edge, almost_touching, near, far };
inline constexpr Nearness every_nearness[] = {Nearness::common_corner, Nearness::common_edge, Nearness::almost_touching,
                                              Nearness::near, Nearness::far};

class RandomPairs {
 public:
  explicit RandomPairs(std::uint64_t seed) : random_(seed, 0, 0) {}

  double next() { return random_.next(); }
  Vec3 direction() {
    const double z = 2 * next() - 1, angle = 2 * pi * next(), r = std::sqrt(1 - z * z);
    return {r * std::cos(angle), r * std::sin(angle), z};
  }
  /// A triangle or trapezoid whose base has length `size`.
  geometry::Ring ring(double size) {
    const Vec3 n = direction(), x = n.unitOrthogonal(), y = n.cross(x);
    const double angle = 2 * pi * next(), height = size * (.25 + .75 * next()), top = size * (.3 + .7 * next()),
                 lean = size * (next() - .5);
    const Vec3 X = std::cos(angle) * x + std::sin(angle) * y, Y = n.cross(X), base = .5 * size * X;
    if (next() < .5) return {-base, base, lean * X + height * Y};
    const double shift = .3 * lean;
    return {-base, base, (shift + .5 * top) * X + height * Y, (shift - .5 * top) * X + height * Y};
  }
  /// The base of the first is 1 m, that of the second between 0.3 and 3 m; neither is behind the other.
  RingPair pair(Nearness nearness) {
    while (true) {
      RingPair found = attempt(nearness);
      if (in_front(found.a, found.b) && in_front(found.b, found.a)) return found;
    }
  }

 private:
  RingPair attempt(Nearness nearness) {
    const double size = std::pow(10.0, next() - .5);
    const geometry::Ring a = ring(1);
    if (nearness == Nearness::common_edge) return {a, on_first_edge(a, size)};
    geometry::Ring b = ring(size);
    const Vec3 shift = offset(nearness, a, b, size);
    for (Vec3& p : b) p += shift;
    if (nearness == Nearness::common_corner) *nearest(b, a[0]) = a[0];
    return {a, b};
  }
  Vec3 offset(Nearness nearness, const geometry::Ring& a, const geometry::Ring& b, double size) {
    Vec3 touching = a[0] - b[static_cast<std::size_t>(next() * static_cast<double>(b.size()))];
    switch (nearness) {
      case Nearness::common_corner:
        return touching;
      case Nearness::almost_touching:
        return touching + std::pow(10.0, -1 - 4 * next()) * direction();
      case Nearness::near:
        return (1 + size) * (.4 + .6 * next()) * direction();
      default:
        return (1 + size) * std::pow(10.0, .1 + 1.4 * next()) * direction();
    }
  }
  geometry::Ring on_first_edge(const geometry::Ring& a, double size) {
    const Vec3 along = a[1] - a[0], n = normal_of(a), across = n.cross(along).normalized();
    const double angle = pi * next(), height = size * (.25 + next());
    const Vec3 up = height * (std::cos(angle) * across + std::sin(angle) * n);
    if (next() < .5) return {a[1], a[0], a[0] + next() * along + up};
    const double left = .2 * next(), right = .7 + .3 * next();
    return {a[1], a[0], a[0] + left * along + up, a[0] + right * along + up};
  }
  static geometry::Ring::iterator nearest(geometry::Ring& ring, const Vec3& x) {
    return std::min_element(ring.begin(), ring.end(),
                            [&](const Vec3& p, const Vec3& q) { return (p - x).norm() < (q - x).norm(); });
  }
  static bool in_front(const geometry::Ring& ring, const geometry::Ring& of) {
    const Vec3 n = normal_of(of);
    return std::all_of(ring.begin(), ring.end(), [&](const Vec3& p) { return n.dot(p - of[0]) >= -1e-14; });
  }

  core::RandomNumbers random_;
};

}  // namespace interflect::fem::test

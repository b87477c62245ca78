#pragma once

#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/random.h"
#include "scene/builder.h"

/// Scenes that tests of rays and of paths are made of.
namespace interflect::test {

using geometry::TriangleCorners;

inline scene::Material diffuse(const std::string& name, double reflectance, double exitance,
                               scene::Sides sides = scene::Sides::front) {
  scene::Material material;
  material.name = name;
  material.reflectance[0] = reflectance;
  material.exitance[0] = exitance;
  material.sides = sides;
  return material;
}

/// x -> scale * x + shift, the scales and places that a method must not notice.
struct Placing {
  double scale = 1;
  Vec3 shift = Vec3::Zero();
  Vec3 operator()(const Vec3& x) const { return scale * x + shift; }
};
inline const std::array<Placing, 4> placings{Placing{}, Placing{1e-6, Vec3::Zero()}, Placing{1e6, Vec3::Zero()},
                                             Placing{1, Vec3(1e9, -1e9, 1e9)}};

/// Geodesic sphere about the origin: 20 * 4^level triangles with corners on the sphere, seen from outside
/// counter-clockwise (or from inside).
inline std::vector<TriangleCorners> icosphere(int level, double radius, bool inward) {
  const double g = (1 + std::sqrt(5.0)) / 2;
  const std::array<Vec3, 12> v{Vec3(-1, g, 0), Vec3(1, g, 0), Vec3(-1, -g, 0), Vec3(1, -g, 0),
                               Vec3(0, -1, g), Vec3(0, 1, g), Vec3(0, -1, -g), Vec3(0, 1, -g),
                               Vec3(g, 0, -1), Vec3(g, 0, 1), Vec3(-g, 0, -1), Vec3(-g, 0, 1)};
  constexpr std::array<std::array<int, 3>, 20> face{{{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                                     {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                                     {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                                     {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}}};
  std::vector<TriangleCorners> triangles;
  for (const auto& [a, b, c] : face)
    triangles.push_back(
        {v[static_cast<std::size_t>(a)], v[static_cast<std::size_t>(b)], v[static_cast<std::size_t>(c)]});
  for (int l = 0; l < level; ++l) {
    std::vector<TriangleCorners> finer;
    for (const auto& [a, b, c] : triangles) {
      // The midpoint of (a, b) and of (b, a) are equal bit by bit: neighbours share their corners exactly.
      const Vec3 ab = (a + b) / 2, bc = (b + c) / 2, ca = (c + a) / 2;
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    triangles = std::move(finer);
  }
  for (auto& corners : triangles) {
    for (Vec3& corner : corners) corner = radius * corner.normalized();
    if (inward) std::swap(corners[1], corners[2]);
  }
  return triangles;
}

/// Rotation by random Euler angles: tests shall not live on axis-parallel planes alone.
inline Eigen::Matrix3d random_rotation(core::RandomNumbers& numbers) {
  const double a = 6 * numbers.next(), b = 6 * numbers.next(), c = 6 * numbers.next();
  return (Eigen::AngleAxisd(a, Vec3::UnitZ()) * Eigen::AngleAxisd(b, Vec3::UnitX()) *
          Eigen::AngleAxisd(c, Vec3::UnitZ()))
      .matrix();
}

/// A star-shaped polygon about the origin of the xy plane with `corners` random radii in [0.6, 1] and no interior angle
/// below 92 degrees; counter-clockwise, and not convex as a rule.
inline geometry::Ring random_star(int corners, core::RandomNumbers& numbers) {
  for (;;) {
    geometry::Ring ring;
    for (int i = 0; i < corners; ++i) {
      const double phi = 2 * pi * (i + 0.4 * numbers.next()) / corners, r = 0.6 + 0.4 * numbers.next();
      ring.emplace_back(r * std::cos(phi), r * std::sin(phi), 0);
    }
    bool wide = true;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec3 back = ring[(i + ring.size() - 1) % ring.size()] - ring[i], on = ring[(i + 1) % ring.size()] - ring[i];
      const bool reflex = on.cross(back).z() < 0;
      wide = wide && (reflex || on.normalized().dot(back.normalized()) < -0.035);
    }
    if (wide) return ring;
  }
}

/// Floor, ceiling and walls over a counter-clockwise polygon of the xy plane, seen from inside, each corner passed
/// through `place`.
template <class Place>
void add_prism_room(scene::SceneBuilder& builder, const geometry::Ring& floor, double height,
                    scene::MaterialId material, const Place& place) {
  const Vec3 up(0, 0, height);
  geometry::Ring bottom, top;
  for (const Vec3& corner : floor) bottom.push_back(place(corner));
  for (auto corner = floor.rbegin(); corner != floor.rend(); ++corner) top.push_back(place(*corner + up));
  builder.add_polygon("floor", {bottom, {}}, material);
  builder.add_polygon("ceiling", {top, {}}, material);
  for (std::size_t i = 0; i < floor.size(); ++i) {
    const Vec3 &a = floor[i], &b = floor[(i + 1) % floor.size()];
    builder.add_polygon("wall", {{place(b), place(a), place(a + up), place(b + up)}, {}}, material);
  }
}

/// Uniform in the unit cube.  (Drawn one by one: the order of a call's arguments is the compiler's.)
inline Vec3 random_point(core::RandomNumbers& numbers) {
  const double x = numbers.next(), y = numbers.next(), z = numbers.next();
  return {x, y, z};
}

/// A point uniform on a facet.
inline Vec3 point_on(const scene::Facet& facet, core::RandomNumbers& numbers) {
  const double s = std::sqrt(numbers.next()), v = numbers.next();
  const auto& [a, b, c] = facet.corner;
  return a + s * (1 - v) * (b - a) + s * v * (c - a);
}

/// A cosine-distributed direction about n: a uniform point of the unit sphere plus n.
inline Vec3 cosine_about(const Vec3& n, core::RandomNumbers& numbers) {
  const double z = 1 - 2 * numbers.next(), phi = 2 * pi * numbers.next(), r = std::sqrt(std::max(0.0, 1 - z * z));
  return (n + Vec3(r * std::cos(phi), r * std::sin(phi), z)).normalized();
}

}  // namespace interflect::test

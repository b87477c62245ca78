#include "fem/form_factor/four_parts.h"

#include <algorithm>

#include "geometry/polygon.h"
#include "scene/place.h"

namespace interflect::fem {
namespace {

using Halves = std::array<CellPart, 2>;

/// Longest side squared / area: 2.3 of a regular triangle, 1 of a square.  Parts across are still longer than wide, so
/// that what the difference to the whole does not show, what varies across, is less than what it does.
constexpr double long_from = 16;

double side(std::span<const Vec3> ring, std::size_t k) { return (ring[(k + 1) % ring.size()] - ring[k]).norm(); }

bool is_long(std::span<const Vec3> ring) {
  double longest = 0;
  for (std::size_t k = 0; k < ring.size(); ++k) longest = std::max(longest, side(ring, k));
  return longest * longest > long_from * geometry::vector_area(ring).norm();
}

/// A needle across, between the middles of its long sides; others from the corner opposite the longest one to that, at
/// a right angle, which leaves needles.
Halves halves_of_triangle(std::span<const Vec3> ring) {
  const std::array<double, 3> length{side(ring, 0), side(ring, 1), side(ring, 2)};
  const auto [least, most] = std::minmax_element(length.begin(), length.end());
  const double height = 2 * geometry::vector_area(ring).norm() / *most;
  const auto corner = [&](auto from, std::ptrdiff_t k) -> const Vec3& {
    return ring[static_cast<std::size_t>(from - length.begin() + k) % 3];
  };
  if (*least < 2 * height) {
    const Vec3 &b = corner(least, 0), &c = corner(least, 1), &tip = corner(least, 2);
    const Vec3 on_b = 0.5 * (tip + b), on_c = 0.5 * (tip + c);
    return {CellPart{{tip, on_b, on_c, tip}, 3}, CellPart{{on_b, b, c, on_c}, 4}};
  }
  const Vec3 &a = corner(most, 0), &b = corner(most, 1), &c = corner(most, 2);
  const double along = height > 0 ? (c - a).dot(b - a) / (b - a).squaredNorm() : 0.5;
  const Vec3 foot = a + along * (b - a);
  return {CellPart{{a, foot, c, c}, 3}, CellPart{{foot, b, c, c}, 3}};
}

/// Between the middles of two opposite sides, those that are longer together.
Halves halves_of_quad(std::span<const Vec3> q) {
  const std::size_t k = side(q, 0) + side(q, 2) >= side(q, 1) + side(q, 3) ? 0 : 1;
  const Vec3 &a = q[k], &b = q[k + 1], &c = q[k + 2], &d = q[(k + 3) % 4];
  const Vec3 ab = 0.5 * (a + b), cd = 0.5 * (c + d);
  return {CellPart{{a, ab, cd, d}, 4}, CellPart{{ab, b, c, cd}, 4}};
}

Halves halves_of(std::span<const Vec3> ring) {
  return ring.size() == 3 ? halves_of_triangle(ring) : halves_of_quad(ring);
}

}  // namespace

std::array<CellPart, 4> four_parts(std::span<const Vec3> ring) {
  if (is_long(ring)) {
    const auto [one, other] = halves_of(ring);
    const Halves first = halves_of(one.ring()), second = halves_of(other.ring());
    return {first[0], first[1], second[0], second[1]};
  }
  const auto quarters = scene::quarters_of(ring);
  const auto part = [&](std::size_t k) { return CellPart{quarters[k], ring.size()}; };
  return {part(0), part(1), part(2), part(3)};
}

}  // namespace interflect::fem

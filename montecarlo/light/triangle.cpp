#include "montecarlo/light/triangle.h"

#include <algorithm>

namespace interflect::montecarlo {
namespace {

double longest_side(const std::array<Vec3, 3>& c) {
  return std::max({(c[1] - c[0]).norm(), (c[2] - c[1]).norm(), (c[0] - c[2]).norm()});
}

}  // namespace

TriangleLight::TriangleLight(const std::array<Vec3, 3>& corner, const Vec3& normal, const Spectrum& exitance)
    : FlatLight(normal, 0.5 * (corner[1] - corner[0]).cross(corner[2] - corner[0]).norm(), exitance,
                (corner[0] + corner[1] + corner[2]) / 3, longest_side(corner)),
      corner_(corner) {}

SphericalTriangle TriangleLight::seen_from(const Vec3& x) const {
  return SphericalTriangle(
      {(corner_[0] - x).normalized(), (corner_[1] - x).normalized(), (corner_[2] - x).normalized()});
}

std::optional<Arriving> TriangleLight::arriving_within(const SphericalTriangle& seen, const Vec3& x, double u,
                                                       double v) const {
  const Vec3 way = seen.direction(u, v);
  const double height = (x - corner_[0]).dot(normal_), cosine = -way.dot(normal_);
  if (!(height > 0 && cosine > 0)) return std::nullopt;  // within rounding of the triangle's plane
  const double r = std::min(height / cosine, reach_from(x));
  return Arriving{way, r, x + r * way, normal_, radiance_, 1 / seen.solid_angle()};
}

LightExtent TriangleLight::extent() const { return extent_of(geometry::box_of(corner_)); }

}  // namespace interflect::montecarlo

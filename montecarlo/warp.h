#pragma once

#include <cmath>

#include "core/vec.h"
#include "scene/place.h"

/// Uniform numbers in [0, 1)² turned into directions and points.  Every pdf says its measure.
namespace interflect::montecarlo {

/// Two tangents and a unit normal, right-handed.
struct Frame {
  Vec3 s, t, n;
  Vec3 to_world(const Vec3& local) const { return local.x() * s + local.y() * t + local.z() * n; }
};

/// Source: [Duff et al. 2017] "Building an orthonormal basis, revisited", JCGT 6(1): no branch, no singular direction.
inline Frame frame_around(const Vec3& n) {
  const double sign = std::copysign(1.0, n.z());
  const double a = -1 / (sign + n.z()), b = n.x() * n.y() * a;
  return {{1 + sign * n.x() * n.x() * a, sign * b, -sign * n.x()}, {b, sign + n.y() * n.y() * a, -n.y()}, n};
}

/// A direction about +z with pdf_solid_angle = cos(theta) / pi [1/sr]; z > 0 always, for u < 1.  (Malley: a uniform
/// disk, lifted.)
inline Vec3 cosine_hemisphere(double u, double v) {
  const double r = std::sqrt(u), phi = 2 * pi * v;
  return {r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - u)};
}
inline double cosine_hemisphere_pdf_solid_angle(double cos_theta) { return cos_theta > 0 ? cos_theta * inv_pi : 0; }

/// A point of a triangle with pdf_area = 1 / area.
inline Vec3 triangle_point(const Vec3& a, const Vec3& b, const Vec3& c, double u, double v) {
  const double s = std::sqrt(u);
  return a + s * (1 - v) * (b - a) + s * v * (c - a);
}

/// A point of a triangle or convex quad with pdf_area = 1 / patch.area: the quad's two triangles share u by their
/// areas.
inline Vec3 patch_point(const scene::SurfacePatch& patch, double u, double v) {
  const auto& [a, b, c, d] = patch.corner;
  if (patch.corners == 3) return triangle_point(a, b, c, u, v);
  const double first = (b - a).cross(c - a).norm(), second = (c - a).cross(d - a).norm(),
               part = first / (first + second);
  return u < part ? triangle_point(a, b, c, u / part, v) : triangle_point(a, c, d, (u - part) / (1 - part), v);
}

}  // namespace interflect::montecarlo

#pragma once

#include "core/hemisphere.h"
#include "scene/place.h"

/// Uniform numbers in [0, 1)² turned into directions and points.  Every pdf says its measure; inverses are for tests.
namespace interflect::montecarlo {

using core::cosine_hemisphere;
using core::cosine_hemisphere_inverse;
using core::Frame;
using core::frame_around;
using core::triangle_point;
using core::triangle_point_inverse;
using core::triangle_point_pdf_area;

/// Of `cosine_hemisphere` [1/sr].
inline double cosine_hemisphere_pdf_solid_angle(double cos_theta) { return cos_theta > 0 ? cos_theta * inv_pi : 0; }

/// Of a convex quad's area the part that the first of its two triangles has; 1 of a triangle.
inline double first_triangle_share(const scene::SurfacePatch& patch) {
  if (patch.corners == 3) return 1;
  const auto& [a, b, c, d] = patch.corner;
  const double first = (b - a).cross(c - a).norm(), second = (c - a).cross(d - a).norm();
  return first / (first + second);
}

/// A point of a triangle or convex quad with pdf_area = 1 / patch.area: the quad's two triangles share u by their
/// areas.
/// @param part  first_triangle_share, for who asks often
inline Vec3 patch_point(const scene::SurfacePatch& patch, double part, double u, double v) {
  const auto& [a, b, c, d] = patch.corner;
  return u < part ? triangle_point(a, b, c, u / part, v) : triangle_point(a, c, d, (u - part) / (1 - part), v);
}
inline Vec3 patch_point(const scene::SurfacePatch& patch, double u, double v) {
  return patch_point(patch, first_triangle_share(patch), u, v);
}

/// Of `patch_point` [1/m²].
inline double patch_point_pdf_area(const scene::SurfacePatch& patch) { return 1 / patch.area; }

/// Whether a point of a patch is drawn in the first of its triangles.
inline bool in_first_triangle(const scene::SurfacePatch& patch, const Vec3& point) {
  if (patch.corners == 3) return true;
  const auto& [a, b, c, d] = patch.corner;
  return (c - a).cross(point - a).dot((c - a).cross(d - b)) < 0;
}

/// (u, v) of a point of the patch.  Round trip: as of triangles, but on the diagonal, which both of a quad's have.
inline Vec2 patch_point_inverse(const scene::SurfacePatch& patch, double part, const Vec3& point) {
  const auto& [a, b, c, d] = patch.corner;
  const bool first = in_first_triangle(patch, point);
  const Vec2 within = first ? triangle_point_inverse(a, b, c, point) : triangle_point_inverse(a, c, d, point);
  return {first ? part * within.x() : part + (1 - part) * within.x(), within.y()};
}
inline Vec2 patch_point_inverse(const scene::SurfacePatch& patch, const Vec3& point) {
  return patch_point_inverse(patch, first_triangle_share(patch), point);
}

}  // namespace interflect::montecarlo

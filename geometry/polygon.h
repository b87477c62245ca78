#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/vec.h"

namespace interflect::geometry {

/// Geometry that cannot be what it claims to be (no area, not planar, crosses itself); the reader adds file and place.
class Defect : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

using Ring = std::vector<Vec3>;  ///< corners [m] of a closed polyline, the last joined to the first

/// A planar polygon with holes.  The outer ring runs counter-clockwise around the front side; holes lie inside it, run
/// either way and do not touch.
struct PlanarPolygon {
  Ring outer;
  std::vector<Ring> holes;
};

/// The plane n . x = offset.
struct Plane {
  Vec3 normal;                                                             ///< unit length
  double offset;                                                           ///< [m]
  double distance(const Vec3& x) const { return normal.dot(x) - offset; }  ///< signed [m], positive in front
};

/// sum_k r_k x r_{k+1} / 2: the normal times the area (Newell), exact for planar rings, taken about the first corner.
Vec3 vector_area(std::span<const Vec3> ring);

/// Area of the outer ring less that of the holes [m²].
double area(const PlanarPolygon& polygon);

/// The plane through the mean of a ring's corners, across its vector area.  Throws Defect without an area.
Plane plane_of(std::span<const Vec3> ring);

/// The same plane by a point of it, so that an offset of the whole ring costs distances no digits.
struct LocalPlane {
  Vec3 normal, point;
  double distance(const Vec3& x) const { return normal.dot(x - point); }
};
LocalPlane local_plane_of(std::span<const Vec3> ring);

/// Largest distance of a corner (holes too) from `plane_of(outer)`, divided by the polygon's diameter.
double relative_planarity_error(const PlanarPolygon& polygon);

/// A polygon counts as planar if its `relative_planarity_error` is at most this.
inline constexpr double planarity_tolerance = 1e-6;

/// Throws Defect in one sentence if the polygon has fewer than three corners, a coordinate that is not finite, no area,
/// is not planar, crosses itself, or has a hole that is not inside.
void require_valid(const PlanarPolygon& polygon);

}  // namespace interflect::geometry

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/polygon.h"

namespace interflect::geometry {

/// The closed half-space n . r >= offset of positions r relative to an eye.
struct HalfSpace {
  Vec3 normal;  ///< of any length
  double offset = 0;
};

/// Something convex that hides what lies beyond it: a flat polygon, or a solid.
///
/// From an eye outside, a solid hides the cone over its outline, beyond its front: the intersection of one half-space
/// for each edge between a face that fronts the eye and one that does not (the plane through the eye and the edge),
/// and, where that matters, of those behind the fronting faces.  A flat polygon is a solid of two faces.
class ConvexBlocker {
 public:
  /// @param ring  planar, convex, 3 corners or more [m]   @throws Defect  without an area
  static ConvexBlocker polygon(std::span<const Vec3> ring);
  /// @param faces  of a closed convex polyhedron, counter-clockwise from outside; neighbours share corners bit by bit
  /// @throws Defect  where an edge does not belong to two faces
  static ConvexBlocker solid(std::span<const Ring> faces);

  std::span<const Vec3> corners() const { return corners_; }
  std::span<const Plane> planes() const { return planes_; }  ///< of the faces, outwards; a polygon has two
  struct Edge {
    std::uint32_t from, to, left, right;  ///< corners, and the faces that it bounds: counter-clockwise around the left
  };
  std::span<const Edge> edges() const { return edges_; }
  std::span<const Ring> faces() const { return rings_; }  ///< one, for a polygon
  bool flat() const { return rings_.size() == 1; }

  /// Appends the half-spaces whose intersection is hidden from `eye`; false, and nothing, where the eye sees no face of
  /// it: it lies in the plane of a polygon, or in the solid or on its surface, where the faces one by one are what
  /// hides.
  /// @param rounding  an eye as near to a face's plane does not see that face [m]
  bool append_shadow(const Vec3& eye, double rounding, std::vector<HalfSpace>& shadow) const;

 private:
  std::vector<Vec3> corners_;
  std::vector<Ring> rings_;
  std::vector<Plane> planes_;  ///< of the faces, outwards; a polygon has two
  std::vector<Edge> edges_;
};

/// A triangle of a scene, as what hides.
struct BlockingTriangle {
  std::array<Vec3, 3> corner;  ///< counter-clockwise around its front [m]
  bool dark_back;              ///< nothing leaves its back, so that what it bounds may be taken for solid
};

/// Triangles as few convex blockers: those of one plane that share an edge are joined as long as they stay convex, and
/// closed convex polyhedra with dark backs become solids.
/// @param rounding  of coordinates [m]
std::vector<ConvexBlocker> convex_blockers(std::span<const BlockingTriangle> triangles, double rounding);

}  // namespace interflect::geometry

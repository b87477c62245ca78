#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/convex_blocker.h"

namespace interflect::fem {

/// A convex blocker as a pair of convex polygons sees it: of its edges and faces only those that can cut a shadow's
/// border through the inner one, for an eye anywhere in the outer one.
///
/// On which side of the plane through an eye x and an edge (a, b) a point y lies is the sign of det(a - x, b - x, y -
/// x), which is linear in x and in y: what it is from all corners to all corners it is throughout.  So an edge whose
/// plane has all of the inner polygon inside never cuts, and one of the outline that has all of it outside proves that
/// the blocker hides nothing.  A solid of hundreds of faces is left with a few.
class PairShadow {
 public:
  /// An edge that may be in the outline.
  struct Edge {
    Vec3 from, to;
    std::uint32_t left, right;  ///< faces of the blocker
    bool fixed;                 ///< it always is, and that always
    bool left_fronts;           ///< while it is: with its left face towards the eye; of no meaning where either may be
  };
  struct Face {
    geometry::Plane plane;
    bool fixed;  ///< it fronts every eye
  };

  /// @param outer, inner  convex rings [m]
  /// @param rounding      of coordinates [m]
  /// @return  false where the blocker is proved to hide nothing
  bool prepare(const geometry::ConvexBlocker& blocker, std::span<const Vec3> outer, std::span<const Vec3> inner,
               double rounding);

  const geometry::ConvexBlocker& blocker() const { return *blocker_; }
  std::span<const Edge> edges() const { return edges_; }
  /// Faces that some eyes are before and some behind, with an edge among `edges`.
  std::span<const geometry::Plane> turning() const { return turning_; }
  /// Whether an eye may lie in the blocker or on it: then `append` is of no use, and the blocker as a whole is to be
  /// asked.
  bool touches_eyes() const { return touches_; }

  /// Whether the blocker is proved to hide all of the inner polygon from every eye.
  bool hides_all() const { return !touches_ && edges_.empty() && faces_.empty(); }

  /// Appends half-spaces whose intersection, within the inner polygon, is hidden from an eye of the outer one; none:
  /// all of it is.
  void append(const Vec3& eye, std::vector<geometry::HalfSpace>& shadow) const;

 private:
  enum class Sight : std::uint8_t { from_none, from_some, from_all };
  enum class Where : std::uint8_t { inside, outside, across };

  void find_sights(std::span<const Vec3> outer);
  bool keep_edges(std::span<const Vec3> outer, std::span<const Vec3> inner);
  bool keep_faces(std::span<const Vec3> inner);
  Where where(const Vec3& from, const Vec3& to, std::span<const Vec3> outer, std::span<const Vec3> inner) const;
  bool fronts(std::uint32_t face, const Vec3& eye) const { return blocker_->planes()[face].distance(eye) > rounding_; }

  const geometry::ConvexBlocker* blocker_ = nullptr;
  double rounding_ = 0;
  bool touches_ = false;
  std::vector<Sight> sight_;
  std::vector<std::uint8_t> turns_;
  std::vector<Edge> edges_;
  std::vector<Face> faces_;
  std::vector<geometry::Plane> turning_;
};

}  // namespace interflect::fem

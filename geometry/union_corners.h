#pragma once

#include <span>
#include <vector>

#include "geometry/hidden_part.h"

namespace interflect::geometry {

/// The corners of a union of convex polygons that do not overlap, as a cut leaves them: places where their
/// angles do not add up to a straight line or a full turn.
///
/// Where a corner of one lies within an edge of another, the straight angle of that edge does not count, so that there
/// are as many corners in any case, though some reflex ones are taken for convex ones. Holds memory for its work; not
/// shared between threads.
class UnionCorners {
 public:
  /// @param rings       counter-clockwise about `normal`, or all clockwise
  /// @param same_place  corners as near are one [the rings' unit]
  /// @return  valid until the next call
  std::span<const Vec3> operator()(const RingList& rings, const Vec3& normal, double same_place);

 private:
  struct Place {
    Vec3 at;
    double angle;  ///< of all corners there [rad]
  };
  void collect_distinct(std::span<const Vec3> ring, double same_place);
  void add(const Vec3& at, double angle, double same_place);

  std::vector<Place> places_;
  std::vector<Vec3> distinct_;  ///< of one ring
  std::vector<Vec3> corners_;
};

}  // namespace interflect::geometry

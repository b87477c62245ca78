#pragma once

#include <array>
#include <span>

#include "geometry/polygon.h"

namespace interflect::fem {

/// A convex polygon as it appears on a view plane.
struct ProjectedPolygon {
  static constexpr int capacity = 12;
  std::array<double, capacity> x,
      y;  ///< corners, in order of either orientation; distances from the plane's foot, in units of its distance
  int corners = 0;  ///< 0 where nothing of it appears, else 3 or more
  /// Nearness 1 / depth is linear on the view plane, q(x, y) = q0 + qx x + qy y [1/m], depth being measured along the
  /// plane's axis.
  double q0 = 0, qx = 0, qy = 0;
};

/// A rectangle [x_low, x_high] x [y_low, y_high] of the plane at distance 1 before an eye.  Its axes are those of the
/// eye's frame, so that nothing is multiplied to turn into it.
class ViewPlane {
 public:
  /// A signed axis of the eye's frame: 0, 1, 2 for s, t, n.
  struct Axis {
    int index;
    double sign;
  };
  struct Rectangle {
    double x_low, x_high, y_low, y_high;
  };
  ViewPlane(Axis right, Axis up, Axis forward, const Rectangle& rectangle);

  /// A square across the zenith, |x|, |y| <= half_side.
  static ViewPlane top(double half_side);
  /// The four sides of a hemicube, |x| <= 1, 0 <= y <= height: side k is turned by k quarters about the zenith.
  static ViewPlane side(int k, double height);

  /// Perspective projection, clipped to the pyramid over the rectangle.
  /// @param ring, plane  of a convex polygon, in the eye's local coordinates (Eye::local); 3 or 4 corners
  /// @return  without corners where nothing of it lies in the pyramid, or where the eye lies in its plane
  ProjectedPolygon project(std::span<const Vec3> ring, const geometry::Plane& plane) const;

  const Rectangle& rectangle() const { return rectangle_; }

 private:
  Vec3 to_face(const Vec3& local) const {
    return {right_.sign * local[right_.index], up_.sign * local[up_.index], forward_.sign * local[forward_.index]};
  }

  Axis right_, up_, forward_;
  Rectangle rectangle_;
  std::array<geometry::Plane, 4>
      pyramid_;  ///< through the eye, fronts inwards, in (x, y, depth); normals of any length
};

}  // namespace interflect::fem

#pragma once

#include <cstdint>
#include <span>

#include "core/vec.h"

namespace interflect::fem {

/// From the unit square onto a triangle or a convex planar quad, area onto area: uniform numbers become uniform points,
/// and evenly spread numbers evenly spread points.
///
/// Triangles by the map of [Turk 1990].  Quads by the bilinear map of (s, t), whose Jacobian w0 + s ws + t wt is linear
/// on a plane, at s and t drawn by inversion: s from its marginal density, t from the conditional one.  Of a
/// parallelogram, within rounding, it is constant: s = u, t = v.
class UniformMap {
 public:
  /// @param ring  3 or 4 corners [m]
  explicit UniformMap(std::span<const Vec3> ring);
  /// @param u, v  in [0, 1]
  Vec3 operator()(double u, double v) const {
    return shape_ == Shape::parallelogram ? Vec3(corner_ + u * along_s_ + v * along_t_) : bent(u, v);
  }

 private:
  Vec3 bent(double u, double v) const;

  enum class Shape : std::uint8_t { triangle, parallelogram, quad };
  Shape shape_;
  Vec3 corner_, along_s_, along_t_, twist_ = Vec3::Zero();
  double jacobian_ = 1, jacobian_s_ = 0, jacobian_t_ = 0;  ///< up to a factor
};

}  // namespace interflect::fem

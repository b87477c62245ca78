#pragma once

#include "core/vec.h"

namespace interflect::geometry {

/// The two coordinates that remain when a plane is looked at along the axis nearest to its normal.  Nothing is
/// computed, so what is collinear in space stays so to the last bit; the order of the axes keeps counter-clockwise
/// rings so.
class AxisShadow {
 public:
  explicit AxisShadow(const Vec3& normal) {
    normal.cwiseAbs().maxCoeff(&dropped_);
    first_ = (dropped_ + 1) % 3;
    second_ = (dropped_ + 2) % 3;
    if (normal[dropped_] < 0) std::swap(first_, second_);
  }
  double x(const Vec3& r) const { return r[first_]; }
  double y(const Vec3& r) const { return r[second_]; }
  Vec2 operator()(const Vec3& r) const { return {x(r), y(r)}; }

 private:
  int dropped_ = 2, first_ = 0, second_ = 1;
};

}  // namespace interflect::geometry

#pragma once

#include <array>
#include <cmath>

#include "scene/place.h"

namespace interflect::fem {

/// A point of an element from two numbers in [0, 1), and its weight: the ratio of areas around it, whose mean over the
/// square is 1.
struct WeightedPoint {
  Vec3 position;
  double weight;
};

/// Several of them side by side, for loops that the compiler vectorises.
struct PointLanes {
  static constexpr std::size_t count = 16;
  using Numbers = std::array<double, count>;
  alignas(32) Numbers x, y, z, weight;
  Vec3 position(std::size_t lane) const { return {x[lane], y[lane], z[lane]}; }
};

/// From the unit square onto an element.  Triangles by the area-preserving map of [Turk 1990], weight 1; quads by the
/// bilinear map, whose Jacobian is the weight: linear in (s, t), since on a plane the product of the bilinear terms
/// vanishes.
class ElementMap {
 public:
  explicit ElementMap(const scene::SurfacePatch& patch);
  WeightedPoint operator()(double s, double t) const {
    if (triangle_) {
      const double root = std::sqrt(s);
      return {corner_ + (root * (1.0 - t)) * along_s_ + (root * t) * along_t_, 1.0};
    }
    return {corner_ + s * along_s_ + t * along_t_ + (s * t) * twist_, weight_ + s * weight_s_ + t * weight_t_};
  }

  /// The same for all lanes.
  PointLanes operator()(PointLanes::Numbers s, PointLanes::Numbers t) const {
    PointLanes out;
    if (triangle_)
      for (std::size_t l = 0; l < PointLanes::count; ++l) {
        const double root = std::sqrt(s[l]);
        s[l] = root * (1.0 - t[l]);
        t[l] *= root;
      }
    const Vec3 c = corner_, a = along_s_, b = along_t_, d = twist_;
    const double w = weight_, ws = weight_s_, wt = weight_t_;
    for (std::size_t l = 0; l < PointLanes::count; ++l) {
      out.x[l] = c.x() + s[l] * a.x() + t[l] * b.x() + s[l] * t[l] * d.x();
      out.y[l] = c.y() + s[l] * a.y() + t[l] * b.y() + s[l] * t[l] * d.y();
      out.z[l] = c.z() + s[l] * a.z() + t[l] * b.z() + s[l] * t[l] * d.z();
      out.weight[l] = w + s[l] * ws + t[l] * wt;
    }
    return out;
  }

 private:
  bool triangle_;
  Vec3 corner_, along_s_, along_t_, twist_ = Vec3::Zero();
  double weight_ = 1.0, weight_s_ = 0.0, weight_t_ = 0.0;
};

}  // namespace interflect::fem

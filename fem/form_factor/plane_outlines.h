#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "core/vec.h"
#include "scene/place.h"

namespace interflect::fem {

/// Elements of a plane by their edges in it, in single precision and a line of cache each: which one surely holds a
/// point, but for points so close to an edge that this cannot be told.
class PlaneOutlines {
 public:
  /// @param patches  that do not overlap
  explicit PlaneOutlines(std::span<const scene::SurfacePatch> patches);

  /// Whether they lie in a plane at all; if not, nothing else may be asked.
  bool flat() const { return !outlines_.empty(); }
  /// Where a point of the plane lies in it, from the middle of all.
  Eigen::Vector2f at(const Vec3& x) const {
    const Vec3 d = x - origin_;
    return {static_cast<float>(s_.dot(d)), static_cast<float>(t_.dot(d))};
  }
  bool surely_holds(std::uint32_t item, const Eigen::Vector2f& x) const {
    const Outline& o = outlines_[item];
    return (o.s * x.x() + o.t * x.y() - o.offset).minCoeff() > margin_;
  }
  /// Has the processor begin to fetch what surely_holds reads.
  void prefetch(std::uint32_t item) const { __builtin_prefetch(&outlines_[item]); }

 private:
  /// Unit vectors into the element, across its edges; what is not an edge has all points inside.
  struct alignas(64) Outline {
    Eigen::Array4f s = Eigen::Array4f::Zero(), t = s, offset = Eigen::Array4f::Constant(-1e30F);
  };

  Vec3 origin_ = Vec3::Zero(), s_ = Vec3::Zero(), t_ = Vec3::Zero();
  float margin_ = 0;  ///< of rounding [m]
  std::vector<Outline> outlines_;
};

}  // namespace interflect::fem

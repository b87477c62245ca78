#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/vec.h"
#include "scene/place.h"

namespace interflect::fem {

/// Elements of a plane by their edges in it, in single precision and a line of cache each: which one surely holds a
/// point, but for points so close to an edge that this cannot be told.  Cells of a grid, about four along each element,
/// know two that likely hold their points.
class PlaneOutlines {
 public:
  static constexpr std::uint32_t none = ~0u;

  /// @param patches  that do not overlap
  explicit PlaneOutlines(std::span<const scene::SurfacePatch> patches);

  /// Whether they lie in a plane at all; if not, nothing else may be asked.
  bool flat() const { return !outlines_.empty(); }
  /// Where a point of the plane lies in it, from the middle of all.
  Eigen::Vector2f at(const Vec3& x) const {
    const Vec3 d = x - origin_;
    return {static_cast<float>(s_.dot(d)), static_cast<float>(t_.dot(d))};
  }
  /// Two elements that likely hold a point, first the one that holds the middle of its cell, if any does; `none` in the
  /// place of what is not there.
  using Likely = std::array<std::uint32_t, 2>;
  const Likely& likely(const Eigen::Vector2f& x) const { return likely_[cell(1, x) * across_ + cell(0, x)]; }
  bool surely_holds(std::uint32_t item, const Eigen::Vector2f& x) const {
    const Outline& o = outlines_[item];
    return (o.s * x.x() + o.t * x.y() - o.offset).minCoeff() > margin_;
  }
  /// Has the processor begin to fetch what surely_holds reads, where that is there.
  void prefetch(std::uint32_t item) const {
    if (item != none) __builtin_prefetch(&outlines_[item]);
  }

 private:
  /// Unit vectors into the element, across its edges; what is not an edge has all points inside.
  struct alignas(64) Outline {
    Eigen::Array4f s = Eigen::Array4f::Zero(), t = s, offset = Eigen::Array4f::Constant(-1e30F);
  };

  std::size_t cell(Index axis, const Eigen::Vector2f& x) const {
    const float place = (x[axis] - low_[axis]) * per_length_[axis];
    return place > 0 ? static_cast<std::size_t>(std::min(place, last_[axis])) : 0;
  }
  void spread_cells(std::span<const scene::SurfacePatch> patches);
  void take_places(std::span<const Eigen::AlignedBox2f> boxes, const Eigen::Array2f& in_cell);

  Vec3 origin_ = Vec3::Zero(), s_ = Vec3::Zero(), t_ = Vec3::Zero();
  float margin_ = 0;  ///< of rounding [m]
  std::vector<Outline> outlines_;
  Eigen::Vector2f low_ = Eigen::Vector2f::Zero();
  Eigen::Array2f per_length_ = Eigen::Array2f::Zero(), last_ = per_length_;  ///< the last cell, in either direction
  std::size_t across_ = 1;                                                   ///< cells in a row
  std::vector<Likely> likely_;                                               ///< of cells
};

}  // namespace interflect::fem

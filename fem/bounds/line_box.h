#pragma once

#include <algorithm>
#include <utility>

#include "geometry/box.h"

namespace interflect::fem {

/// Whether x + t d, with t from `begin` to `end`, comes as near to a box as `margin` along each axis.
inline bool passes_box(const Vec3& x, const Vec3& d, double begin, double end, const geometry::Box& box,
                       double margin) {
  for (int axis = 0; axis < 3; ++axis) {
    const double low = box.min()[axis] - margin - x[axis], high = box.max()[axis] + margin - x[axis];
    if (d[axis] == 0) {
      if (low > 0 || high < 0) return false;
      continue;
    }
    const auto [enters, leaves] = std::minmax({low / d[axis], high / d[axis]});
    begin = std::max(begin, enters);
    end = std::min(end, leaves);
  }
  return begin <= end;
}

}  // namespace interflect::fem

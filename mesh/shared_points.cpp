#include "mesh/shared_points.h"

#include <cmath>

namespace interflect::mesh {

std::optional<std::uint32_t> SharedPoints::find(const Vec3& p, const Vec3& normal) const {
  static const double nearly_flat = std::cos(pi / 9);
  const auto here = known_.find(key(p));
  if (here == known_.end()) return std::nullopt;
  for (const Known& known : here->second)
    if (known.normal.dot(normal) > nearly_flat) return known.number;
  return std::nullopt;
}

}  // namespace interflect::mesh

#include "fem/form_factor/orientation.h"

#include <algorithm>

namespace interflect::fem {
namespace {

bool behind(const ElementShapes& shapes, const ElementShape& of, const ElementShape& over) {
  const double rounding = shapes.height_tolerance(over, of.centroid);
  return std::ranges::all_of(of.ring(), [&](const Vec3& corner) { return over.plane.distance(corner) <= rounding; });
}

}  // namespace

bool facing_away(const ElementShapes& shapes, Index i, Index j) {
  const ElementShape &a = shapes[i], &b = shapes[j];
  return behind(shapes, a, b) || behind(shapes, b, a);
}

}  // namespace interflect::fem

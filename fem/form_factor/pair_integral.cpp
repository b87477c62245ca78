#include "fem/form_factor/pair_integral.h"

#include <algorithm>

#include "fem/form_factor/far_field.h"
#include "geometry/clip.h"

namespace interflect::fem {

namespace {

/// Heights of an element's corners over another's plane, and what of them is rounding at most [m].
struct Heights {
  double lowest, highest, rounding;
  bool behind() const { return highest <= rounding; }
  bool in_front() const { return lowest >= -rounding; }
};

Heights heights(const ElementShapes& shapes, const ElementShape& of, const ElementShape& over) {
  double lowest = over.plane.distance(of.corner[0]), highest = lowest;
  for (std::size_t k = 1; k < of.corners; ++k) {
    const double height = over.plane.distance(of.corner[k]);
    lowest = std::min(lowest, height);
    highest = std::max(highest, height);
  }
  return {lowest, highest, shapes.height_tolerance(over, of.centroid)};
}

Integral near_field(const ElementShape& a, const ElementShape& b, double tolerance) {
  const bool a_is_outer = a.radius <= b.radius;
  const ElementShape &outer = a_is_outer ? a : b, &inner = a_is_outer ? b : a;
  return adaptive_lambert(outer.ring(), outer.plane.normal, inner.ring(), tolerance);
}

Pieces pieces_of(const geometry::ConvexRing& ring, const geometry::Plane& plane) {
  Pieces pieces;
  const auto corners = static_cast<std::size_t>(ring.corners);
  for (std::size_t first = 1; first + 1 < corners; first += 2) {
    std::array<Vec3, 4> part = {ring.corner[0], ring.corner[first], ring.corner[first + 1], ring.corner[0]};
    std::size_t part_corners = 3;
    if (first + 2 < corners) part[part_corners++] = ring.corner[first + 2];
    const ElementShape shape = shape_of({part.data(), part_corners}, plane);
    if (shape.area > 0.0 && pieces.count < pieces.shape.size()) pieces.shape[pieces.count++] = shape;
  }
  return pieces;
}

}  // namespace

Pieces pieces_in_front(const ElementShape& of, const geometry::Plane& plane) {
  return pieces_of(geometry::clip(of.ring(), plane), of.plane);
}

PairIntegral PairIntegrator::operator()(Index i, Index j) const {
  const ElementShape &a = shapes_[i], &b = shapes_[j];
  const Heights of_b = heights(shapes_, b, a);
  if (of_b.behind()) return {};
  const Heights of_a = heights(shapes_, a, b);
  if (of_a.behind()) return {};
  if (!of_a.in_front() || !of_b.in_front()) {
    const Integral part = clipped_pair(a, b);
    return {part.value > 0.0 ? Facing::crossing : Facing::away, part.value, part.error};
  }
  const Integral whole = unclipped(a, b, [&](int level) {
    return far_field(shapes_.nodes(i, level), a.plane, shapes_.nodes(j, level), b.plane);
  });
  return {Facing::full, whole.value, whole.error};
}

/// The far field where it will do, from the level that promises to, and else the near field.
template <class FarField>
Integral PairIntegrator::unclipped(const ElementShape& a, const ElementShape& b, const FarField& far) const {
  const FarPair pair = far_pair(a, b);
  int level = far_field_level(pair, tolerance_);
  if (level == ElementShapes::levels) return near_field(a, b, tolerance_);
  double before = far(level - 1);
  for (; level < ElementShapes::levels; ++level) {
    const double value = std::max(0.0, far(level)), error = far_field_error(level, pair, value - before, value);
    if (error <= tolerance_ * value) return {value, error};
    before = value;
  }
  return near_field(a, b, tolerance_);
}

Integral PairIntegrator::clipped_pair(const ElementShape& a, const ElementShape& b) const {
  const Pieces of_a = pieces_in_front(a, b.plane), of_b = pieces_in_front(b, a.plane);
  Integral sum;
  for (std::size_t k = 0; k < of_a.count; ++k)
    for (std::size_t l = 0; l < of_b.count; ++l) {
      const ElementShape &p = of_a.shape[k], &q = of_b.shape[l];
      const Integral part = unclipped(p, q, [&](int level) {
        const NodeBuffer nodes_p(p, shapes_.rules(level)), nodes_q(q, shapes_.rules(level));
        return far_field(nodes_p.arrays(), p.plane, nodes_q.arrays(), q.plane);
      });
      sum.value += part.value;
      sum.error += part.error;
    }
  return sum;
}

}  // namespace interflect::fem

#include "fem/form_factor/pair_integral.h"

#include <algorithm>
#include <limits>

#include "fem/form_factor/adaptive_lambert.h"
#include "fem/form_factor/far_field.h"
#include "fem/form_factor/polygon_pair.h"
#include "fem/form_factor/rectangle_pair.h"
#include "geometry/clip.h"

namespace interflect::fem {

namespace {

constexpr std::size_t most_lambert_cells = 1000;

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

bool within(const Integral& integral, double tolerance) { return integral.error <= tolerance * integral.value; }

/// K is in [0, min(A_i, A_j)]: what lies beyond is rounding.
Integral bounded(const Integral& integral, const ElementShape& a, const ElementShape& b) {
  const double value = std::clamp(integral.value, 0.0, std::min(a.area, b.area));
  return {value, std::max(integral.error, std::abs(value - integral.value))};
}

/// The guard: the first of rectangles in closed form, Lambert's formula without a cut, polygons in closed form that
/// promises the tolerance, in the order of their costs (0.4, 3 and 9 microseconds); where rounding forbids, cells of
/// Lambert's formula.
Integral near_field(const ElementShape& a, const ElementShape& b, double tolerance) {
  if (const auto rectangles = rectangle_pair(a.ring(), b.ring()); rectangles && within(*rectangles, tolerance))
    return *rectangles;
  const bool a_is_outer = a.radius <= b.radius;
  const ElementShape &outer = a_is_outer ? a : b, &inner = a_is_outer ? b : a;
  const auto lambert = [&](std::size_t most_cells) {
    return adaptive_lambert(outer.ring(), outer.plane.normal, inner.ring(), {tolerance, most_cells});
  };
  if (expected_lambert_error(outer.ring(), inner.ring()) <= tolerance)
    if (const Integral uncut = lambert(1); within(uncut, tolerance)) return uncut;
  const Integral closed = polygon_pair(outer.ring(), inner.ring(), tolerance);
  if (within(closed, tolerance)) return closed;
  const Integral cut = lambert(most_lambert_cells);
  return closed.error < cut.error ? closed : cut;
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
  const Integral whole = unclipped(
      a, b, [&](int level) { return far_field(shapes_.nodes(i, level), a.plane, shapes_.nodes(j, level), b.plane); });
  return {Facing::full, whole.value, whole.error};
}

/// Of heights over planes, which are rounded on the scale of the distance: 2^-52 r of either.  It is nothing to common
/// tolerances.
double far_rounding(const ElementShape& a, const ElementShape& b, double tolerance) {
  if (tolerance > 1e-7) return 0.0;
  return 2 * std::numeric_limits<double>::epsilon() * inv_pi * a.area * b.area /
         (a.centroid - b.centroid).squaredNorm();
}

/// The far field where it will do, and else the near field.
template <class FarField>
Integral PairIntegrator::unclipped(const ElementShape& a, const ElementShape& b, const FarField& far) const {
  if (const auto rule = far_rule(far_pair(a, b), tolerance_)) {
    const double value = std::max(0.0, far(rule->level)), error = rule->error * value + far_rounding(a, b, tolerance_);
    if (error <= tolerance_ * value) return {value, error};
  }
  return bounded(near_field(a, b, tolerance_), a, b);
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

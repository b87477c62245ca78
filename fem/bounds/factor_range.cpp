#include "fem/bounds/factor_range.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fem/quadrature.h"

namespace interflect::fem {
namespace {

constexpr double first_derivative = 1.6, third_derivative = 17.1;  ///< at most, times pi r³ and pi r^5
constexpr double derivatives_accuracy = 1e-7;

struct AreaAndCentre {
  double area;
  Vec3 centre;
};
AreaAndCentre area_and_centre(std::span<const Vec3> ring, const Vec3& normal) {
  Vec3 sum = Vec3::Zero();
  double twice_all = 0;
  for (std::size_t k = 1; k + 1 < ring.size(); ++k) {
    const double twice = normal.dot((ring[k] - ring[0]).cross(ring[k + 1] - ring[0]));
    sum += twice * ((ring[k] - ring[0]) + (ring[k + 1] - ring[0])) / 3;
    twice_all += twice;
  }
  return {0.5 * std::abs(twice_all), twice_all != 0 ? Vec3(ring[0] + sum / twice_all) : ring[0]};
}

double radius_about(const Vec3& centre, std::span<const Vec3> ring) {
  double square = 0;
  for (const Vec3& x : ring) square = std::max(square, (x - centre).squaredNorm());
  return std::sqrt(square);
}

/// By triangles from the centre, whose means of products are those at their corners and middles of sides.
std::array<double, 3> second_moments_of(const Cell& cell) {
  std::array<double, 3> sum{};
  for (std::size_t k = 0; k < cell.ring.size(); ++k) {
    const Vec2 a = cell.local(cell.ring[k]), b = cell.local(cell.ring[(k + 1) % cell.ring.size()]);
    const double share = 0.5 * (a.x() * b.y() - a.y() * b.x()) / cell.area;
    const Vec2 middles[] = {0.5 * a, 0.5 * b, 0.5 * (a + b)};
    for (const Vec2& m : middles) {
      sum[0] += share / 3 * m.x() * m.x();
      sum[1] += share / 3 * m.x() * m.y();
      sum[2] += share / 3 * m.y() * m.y();
    }
  }
  return sum;
}

struct Heights {
  double least = std::numeric_limits<double>::infinity(), most = 0;
  void add(double height) {
    least = std::min(least, std::max(0.0, height));
    most = std::max(most, height);
  }
};

/// Integrals along an edge R = foot + u (e / length), from <= u <= to, over t.
struct EdgeIntegrals {
  double two, four, six;  ///< of 1 / R², 1 / R^4, 1 / R^6
  double u_four, u_six;   ///< of u / R^4, u / R^6
  double uu_six;          ///< of u² / R^6
  bool accurate = true;
};

/// Far along the edge's line and beside it, where closed forms cancel and the integrands are smooth.
EdgeIntegrals by_nodes(double d, double from, double to) {
  static const Rule rule = gauss_legendre(10);
  EdgeIntegrals sum{};
  for (const RuleNode& node : rule) {
    const double u = from + node.u * (to - from), by_square = 1 / (d * d + u * u);
    const double two = node.weight * by_square, four = two * by_square, six = four * by_square;
    sum.two += two;
    sum.four += four;
    sum.six += six;
    sum.u_four += u * four;
    sum.u_six += u * six;
    sum.uu_six += u * u * six;
  }
  sum.accurate = std::max(std::abs(from), std::abs(to)) < 4 * std::min(std::abs(from), std::abs(to));
  return sum;
}

EdgeIntegrals integrals(double d, double from, double to, double angle) {
  constexpr double far_along = 20;
  if (from * to > 0 && std::max(std::abs(from), std::abs(to)) > far_along * d) return by_nodes(d, from, to);
  const double length = to - from, by_from = 1 / (d * d + from * from), by_to = 1 / (d * d + to * to), square = d * d;
  EdgeIntegrals sum{};
  sum.two = angle / (d * length);
  sum.four = ((to * by_to - from * by_from) / length + sum.two) / (2 * square);
  sum.six = ((to * by_to * by_to - from * by_from * by_from) / length + 3 * sum.four) / (4 * square);
  sum.u_four = (by_from - by_to) / (2 * length);
  sum.u_six = (by_from * by_from - by_to * by_to) / (4 * length);
  sum.uu_six = sum.four - square * sum.six;
  return sum;
}

/// Sums over edges, times 2 pi.
struct EdgeSum {
  double value = 0;
  Vec2 gradient = Vec2::Zero();
  std::array<double, 3> hessian{};
  bool accurate = true;

  /// @param r  from the point to the edge's start
  void add(const Cell& cell, const Vec3& r, const Vec3& e) {
    const Vec3 cross = r.cross(e);
    const double twice = cross.norm(), length = e.norm();
    if (!(length > 0)) return;
    const double d = twice / length, from = r.dot(e) / length, to = from + length;
    if (!(twice > 0) && from * to <= 0) {
      accurate = false;
      return;
    }
    const EdgeIntegrals I = integrals(d, from, to, std::atan2(twice, r.dot(r + e)));
    accurate = accurate && I.accurate;
    const double side = cell.normal.dot(cross);
    const auto flat = [&](const Vec3& v) -> Vec2 { return {v.dot(cell.s), v.dot(cell.t)}; };
    const Vec2 along = flat(e / length), foot = flat(r - from * (e / length)), outwards = flat(e.cross(cell.normal));
    const Vec2 J = I.four * foot + I.u_four * along;
    value += side * (twice > 0 ? std::atan2(twice, r.dot(r + e)) / twice : I.two);
    gradient += 2 * side * J - I.two * outwards;
    const auto second = [&](int a, int b) {
      const double RR = I.six * foot[a] * foot[b] + I.u_six * (foot[a] * along[b] + foot[b] * along[a]) +
                        I.uu_six * along[a] * along[b];
      return side * (8 * RR - (a == b ? 2 * I.four : 0)) - 2 * (outwards[a] * J[b] + outwards[b] * J[a]);
    };
    hessian[0] += second(0, 0);
    hessian[1] += second(0, 1);
    hessian[2] += second(1, 1);
  }
};

EdgeSum by_edges(const Cell& cell, std::span<const Vec3> polygon) {
  EdgeSum sum;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec3& from = polygon[k];
    sum.add(cell, from - cell.centre, polygon[k + 1 < polygon.size() ? k + 1 : 0] - from);
  }
  const double scale = (sum.value < 0 ? -0.5 : 0.5) * inv_pi;
  sum.value *= scale;
  sum.gradient *= scale;
  for (double& h : sum.hessian) h *= scale;
  return sum;
}

double fourth(double r) { return r * r * r * r; }

/// How a polygon lies to a cell.
struct Situation {
  double area, radius;     ///< of the polygon [m²], [m]
  Vec3 between;            ///< from the cell's centre to the polygon's
  double distance, radii;  ///< between the centres, and of both [m]
  Heights c, h;            ///< of the polygon over the cell's plane, and of the cell over the polygon's
  double nearest;          ///< no two points are nearer [m]
};
Situation situation_of(const Cell& cell, std::span<const Vec3> polygon, const geometry::Plane& plane) {
  const auto [area, middle] = area_and_centre(polygon, plane.normal);
  const double radius = radius_about(middle, polygon);
  Situation of{area, radius, middle - cell.centre, 0, cell.radius + radius, {}, {}, 0};
  of.distance = of.between.norm();
  for (const Vec3& y : polygon) of.c.add(cell.normal.dot(y - cell.centre));
  for (const Vec3& x : cell.ring) of.h.add(plane.distance(x));
  of.nearest = std::max({of.c.least, of.h.least, of.distance - of.radii});
  return of;
}

/// Of k = c h / (pi r^4) from anywhere in the cell to anywhere on the polygon, and its derivatives along their planes.
struct KernelBounds {
  double slope, third;  ///< |dk/dv| [1/m³] and |d³k/dv³| [1/m^5], at most
  double least, most;   ///< [1/m²]
};
KernelBounds kernel_bounds(const Situation& of, const Cell& cell, const geometry::Plane& plane) {
  const double z = std::min(1.0, of.c.most / of.nearest), by_square = inv_pi / (of.nearest * of.nearest);
  const double slope = std::min(first_derivative, 3 * z) * by_square / of.nearest,
               third = std::min(third_derivative, 60 * z) * by_square / (of.nearest * of.nearest * of.nearest);
  const double centres = std::max(0.0, cell.normal.dot(of.between)) * std::max(0.0, plane.distance(cell.centre)) *
                         inv_pi / fourth(of.distance);
  return {slope, third,
          std::max(of.c.least * of.h.least * inv_pi / fourth(of.distance + of.radii), centres - of.radii * slope),
          std::min(z * std::min(1.0, of.h.most / of.nearest) * by_square, centres + of.radii * slope)};
}

/// Lambert's formula about the cell's centre to second order.
struct Expansion {
  EdgeSum at_centre;
  double remainder;  ///< of F anywhere in the cell
  double change;     ///< |F - F(centre)|, at most
};
Expansion expansion_of(const Cell& cell, std::span<const Vec3> polygon, double area, double third) {
  Expansion of{by_edges(cell, polygon), 0, 0};
  const auto& [ss, st, tt] = of.at_centre.hessian;
  const double R = cell.radius, first_order = of.at_centre.gradient.norm() * R,
               second_order = 0.5 * R * R * std::sqrt(ss * ss + 2 * st * st + tt * tt);
  of.remainder = R * R * R / 6 * area * third + derivatives_accuracy * (first_order + second_order);
  of.change = first_order + second_order + of.remainder;
  return of;
}

/// The polynomial, where it says more than the least and the most do.
void set_polynomial(FactorRange& range, const Expansion& by) {
  const double half = 0.5 * (range.most - range.least);
  const auto& [value, gradient, hessian, accurate] = by.at_centre;
  range.smooth = accurate && by.remainder < half;
  if (range.smooth) {
    range.value = value;
    range.derivatives = {gradient[0], gradient[1], hessian[0], hessian[1], hessian[2]};
    range.remainder = by.remainder;
  } else {
    range.value = range.least + half;
    range.remainder = half;
  }
}

}  // namespace

Cell cell_of(std::span<const Vec3> ring) {
  const Vec3 by_area = geometry::vector_area(ring);
  Cell frame;
  frame.normal = by_area.normalized();
  frame.s = frame.normal.unitOrthogonal();
  frame.t = frame.normal.cross(frame.s);
  return cell_of(ring, frame);
}

Cell cell_of(std::span<const Vec3> ring, const Cell& wider) {
  Cell cell;
  cell.ring.assign(ring.begin(), ring.end());
  cell.normal = wider.normal;
  cell.s = wider.s;
  cell.t = wider.t;
  const auto [area, centre] = area_and_centre(ring, cell.normal);
  cell.area = area;
  cell.centre = centre;
  cell.radius = radius_about(centre, ring);
  cell.second_moments = second_moments_of(cell);
  return cell;
}

FactorRange factor_range(const Cell& cell, std::span<const Vec3> polygon, const geometry::Plane& plane) {
  const Situation pair = situation_of(cell, polygon, plane);
  const double half_space = std::clamp(0.5 * (1 - cell.normal.dot(plane.normal)), 0.0, 1.0);
  if (!(pair.nearest > 0)) return between_none_and(half_space);
  const KernelBounds k = kernel_bounds(pair, cell, plane);
  const Expansion F = expansion_of(cell, polygon, pair.area, k.third);
  FactorRange range;
  range.across = pair.area * pair.radius * k.slope;
  range.least = std::max(0.0, pair.area * k.least);
  range.most = std::min(half_space, pair.area * k.most);
  if (F.at_centre.accurate) {
    range.least = std::max(range.least, F.at_centre.value - F.change);
    range.most = std::min(range.most, F.at_centre.value + F.change);
  }
  range.most = std::max(range.least, range.most);
  set_polynomial(range, F);
  return range;
}

FactorRange between_none_and(double most) {
  FactorRange part;
  part.most = most;
  part.value = part.remainder = 0.5 * most;
  return part;
}

}  // namespace interflect::fem

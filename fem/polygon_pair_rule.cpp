#include "fem/polygon_pair_rule.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "geometry/clip.h"
#include "geometry/segment.h"
#include "mesh/element_mesh.h"

namespace interflect::fem {
namespace {

using Place = TrianglePairPlaces::Place;

/// Places closer than this, beside the panels' size, are one.
constexpr double same_place = 1e-11;
/// Along what the kernel scales with: exact for its Jacobian and two polynomials of the highest order, degree 7.
constexpr int points_of_polynomials = 4;
static_assert(ElementBasis::highest_order == 3);
/// From middle to middle of triangles that are apart, over the sum of their radii.
constexpr double least_distance = 2;
/// Of products, which leave some 4e-12 at this distance.
constexpr int most_points_apart = 10;
/// Lengths of triangles that touch, over each other, from which on they are cut.
constexpr double most_unequal = 2;
/// Pairs of parts that are apart: those of panels that nearly touch all along are left larger, and less accurate.
constexpr std::size_t most_parts = 10000;
/// Cuts of triangles one after the other.
constexpr int most_cuts = 48;

struct Triangle {
  std::array<Vec3, 3> corner;

  Vec3 middle() const { return (corner[0] + corner[1] + corner[2]) / 3; }
  double radius() const {
    const Vec3 m = middle();
    return std::max({(corner[0] - m).norm(), (corner[1] - m).norm(), (corner[2] - m).norm()});
  }
  double doubled_area() const { return (corner[1] - corner[0]).cross(corner[2] - corner[0]).norm(); }
  Vec3 at(double u, double v) const { return corner[0] + u * (corner[1] - corner[0]) + v * (corner[2] - corner[0]); }
  /// The same, another corner first.
  Triangle from(std::size_t k) const { return {{corner[k], corner[(k + 1) % 3], corner[(k + 2) % 3]}}; }
  Triangle mirrored() const { return {{corner[0], corner[2], corner[1]}}; }
};
using Triangles = std::vector<Triangle>;

/// By the middle of the longest edge: parts of long triangles are less so.
std::array<Triangle, 2> halves(const Triangle& of) {
  const auto& c = of.corner;
  const auto length = [&](std::size_t k) { return (c[(k + 1) % 3] - c[k]).squaredNorm(); };
  const std::size_t longest =
      length(0) >= length(1) ? (length(0) >= length(2) ? 0 : 2) : (length(1) >= length(2) ? 1 : 2);
  const Triangle turned = of.from(longest);
  const auto& [p, q, r] = turned.corner;
  const Vec3 middle = .5 * (p + q);
  return {{{{p, middle, r}}, {{middle, q, r}}}};
}

/// Twice the area over the longest edge squared.
double roundness(const Triangle& of) {
  double longest = 0;
  for (std::size_t k = 0; k < 3; ++k)
    longest = std::max(longest, (of.corner[(k + 1) % 3] - of.corner[k]).squaredNorm());
  return of.doubled_area() / longest;
}

/// Of a convex ring with corners within its sides: the triangulation whose least round triangle is roundest, by dynamic
/// programming over chains of corners i .. j.
class RoundestTriangles {
 public:
  explicit RoundestTriangles(std::span<const Vec3> ring) : ring_(ring), chain_(ring.size() * ring.size()) {
    const std::size_t n = ring.size();
    for (std::size_t length = 2; length < n; ++length)
      for (std::size_t i = 0; i + length < n; ++i)
        for (std::size_t k = i + 1; k < i + length; ++k) {
          const std::size_t j = i + length;
          const double here = std::min({roundness(triangle(i, k, j)), chain(i, k).roundness, chain(k, j).roundness});
          if (k == i + 1 || here > chain(i, j).roundness) chain(i, j) = {here, k};
        }
    if (n >= 3) append(0, n - 1);
  }
  Triangles triangles;

 private:
  struct Chain {
    double roundness = std::numeric_limits<double>::infinity();
    std::size_t apex = 0;  ///< of the triangle over it
  };
  Chain& chain(std::size_t i, std::size_t j) { return chain_[i * ring_.size() + j]; }
  Triangle triangle(std::size_t i, std::size_t k, std::size_t j) const { return {{ring_[i], ring_[k], ring_[j]}}; }
  void append(std::size_t i, std::size_t j) {
    if (j < i + 2) return;
    const std::size_t k = chain(i, j).apex;
    triangles.push_back(triangle(i, k, j));
    append(i, k);
    append(k, j);
  }

  std::span<const Vec3> ring_;
  std::vector<Chain> chain_;
};

Triangles triangles_of(std::span<const Vec3> ring) { return RoundestTriangles(ring).triangles; }

/// What of a panel lies in front of another one's plane.
std::vector<Vec3> in_front(const Panel& of, const Panel& other, double near) {
  const geometry::Plane plane{other.normal, other.normal.dot(other.corner[0])};
  double lowest = plane.distance(of.corner[0]), highest = lowest;
  for (const Vec3& x : of.ring()) {
    lowest = std::min(lowest, plane.distance(x));
    highest = std::max(highest, plane.distance(x));
  }
  if (highest <= near) return {};
  if (lowest >= -near) return {of.ring().begin(), of.ring().end()};
  const geometry::ConvexRing clipped = geometry::clip(of.ring(), plane);
  return {clipped.ring().begin(), clipped.ring().end()};
}

/// A ring, with those corners of another one that lie within its sides.
std::vector<Vec3> with_corners_on_sides(std::vector<Vec3> ring, std::span<const Vec3> other, double near) {
  for (const Vec3& x : other)
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Vec3 &p = ring[k], &q = ring[(k + 1) % ring.size()];
      if (geometry::distance_to_segment(x, p, q) > near) continue;
      if ((x - p).norm() > near && (x - q).norm() > near)
        ring.insert(ring.begin() + static_cast<std::ptrdiff_t>(k) + 1, x);
      break;
    }
  return ring;
}

/// Cut where a point lies in it or on an edge; nothing where it lies elsewhere, or in a corner.
Triangles cut_at(const Triangle& triangle, const Vec3& x, double near) {
  const auto& c = triangle.corner;
  for (const Vec3& corner : c)
    if ((corner - x).norm() <= near) return {};
  for (std::size_t k = 0; k < 3; ++k)
    if (geometry::distance_to_segment(x, c[k], c[(k + 1) % 3]) <= near)
      return {{{c[k], x, c[(k + 2) % 3]}}, {{x, c[(k + 1) % 3], c[(k + 2) % 3]}}};
  const Vec3 normal = (c[1] - c[0]).cross(c[2] - c[0]).normalized();
  if (std::abs(normal.dot(x - c[0])) > near) return {};
  for (std::size_t k = 0; k < 3; ++k)
    if (normal.dot((c[(k + 1) % 3] - c[k]).cross(x - c[k])) < 0) return {};
  return {{{c[0], c[1], x}}, {{c[1], c[2], x}}, {{c[2], c[0], x}}};
}

/// All of `triangles`, cut at corners of others.
Triangles cut_at_corners(const Triangles& triangles, const Triangles& others, double near) {
  Triangles cut = triangles;
  for (const Triangle& other : others)
    for (const Vec3& x : other.corner)
      for (std::size_t k = 0; k < cut.size(); ++k)
        if (const Triangles parts = cut_at(cut[k], x, near); !parts.empty()) {
          cut[k] = parts[0];
          cut.insert(cut.end(), parts.begin() + 1, parts.end());
        }
  return cut;
}

scene::SurfacePatch patch_of(const Panel& panel) {
  return scene::make_patch(scene::SurfaceId{0}, scene::Side::front, panel.ring());
}

/// Visits the nodes of one pair of panels.
class PolygonPairNodes {
 public:
  PolygonPairNodes(const TrianglePairPlaces& places, const Panel& a, const Panel& b, const PairRule::Visit& visit)
      : places_(places), visit_(visit), panel_a_(a), panel_b_(b), a_(patch_of(a)), b_(patch_of(b)) {
    for (const Vec3& x : a.ring()) near_ = std::max(near_, same_place * (x - a.corner[0]).norm());
    for (const Vec3& x : b.ring()) near_ = std::max(near_, same_place * (x - b.corner[0]).norm());
  }
  void visit() {
    const std::vector<Vec3> of_a = in_front(panel_a_, panel_b_, near_), of_b = in_front(panel_b_, panel_a_, near_);
    const Triangles with_a = triangles_of(with_corners_on_sides(of_a, of_b, near_)),
                    with_b = triangles_of(with_corners_on_sides(of_b, of_a, near_)),
                    cut_a = cut_at_corners(with_a, with_b, near_), cut_b = cut_at_corners(with_b, cut_a, near_);
    for (const Triangle& x : cut_a)
      for (const Triangle& y : cut_b) visit_pair(x, y, most_cuts);
    visit_apart();
  }

 private:
  /// By what the two have in common; what is apart is left for `visit_apart`.
  void visit_pair(const Triangle& x, const Triangle& y, int cuts) {
    std::vector<std::pair<std::size_t, std::size_t>> shared;
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t l = 0; l < 3; ++l)
        if ((x.corner[k] - y.corner[l]).norm() <= near_) shared.emplace_back(k, l);
    if (shared.empty()) return cut_apart(x, y, cuts);
    const auto [k, l] = shared[0];
    if (shared.size() == 1) return visit_with_corner(x.from(k), y.from(l), cuts);
    visit_places(edge_first(x, k, shared[1].first), edge_first(y, l, shared[1].second), places_.edge);
  }
  /// From corner k, corner `next` being the second.
  static Triangle edge_first(const Triangle& of, std::size_t k, std::size_t next) {
    return (k + 1) % 3 == next ? of.from(k) : of.from(k).mirrored();
  }
  /// Of one size, or else cut.
  void visit_with_corner(const Triangle& x, const Triangle& y, int cuts) {
    if (cuts > 0 && x.radius() > most_unequal * y.radius())
      for (const Triangle& part : halves(x)) visit_pair(part, y, cuts - 1);
    else if (cuts > 0 && y.radius() > most_unequal * x.radius())
      for (const Triangle& part : halves(y)) visit_pair(x, part, cuts - 1);
    else
      visit_places(x, y, places_.corner);
  }
  void cut_apart(const Triangle& x, const Triangle& y, int cuts) {
    const double r_x = x.radius(), r_y = y.radius();
    const double distance = (x.middle() - y.middle()).norm() / (r_x + r_y);
    if (cuts == 0 || apart_.size() >= most_parts || distance >= least_distance)
      return apart_.push_back({x, y, std::max(distance, least_distance)});
    if (r_x >= r_y)
      for (const Triangle& part : halves(x)) cut_apart(part, y, cuts - 1);
    else
      for (const Triangle& part : halves(y)) cut_apart(x, part, cuts - 1);
  }
  /// On an interval whose kernel is singular at x half lengths from its middle, n points leave rho^-2n,
  /// ln rho = arcosh x [Trefethen 2008]: the nearest have all points, others those that leave as much.
  void visit_apart() {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Apart& pair : apart_) nearest = std::min(nearest, pair.distance);
    const auto most = static_cast<double>(places_.apart.size());
    for (const Apart& pair : apart_) {
      const double share = std::min(1.0, std::acosh(nearest) / std::acosh(pair.distance));
      visit_products(pair.x, pair.y, places_.apart[static_cast<std::size_t>(std::ceil(most * share)) - 1]);
    }
  }
  void visit_products(const Triangle& x, const Triangle& y, const Rule& rule) {
    std::vector<OnPanel> of_y;
    for (const RuleNode& node : rule) of_y.push_back(on_panel(b_, y, node.u, node.v, node.weight));
    for (const RuleNode& node : rule) {
      const OnPanel at_x = on_panel(a_, x, node.u, node.v, node.weight);
      for (const OnPanel& at_y : of_y) visit_node(at_x, at_y);
    }
  }
  void visit_places(const Triangle& x, const Triangle& y, const std::vector<Place>& places) {
    for (const Place& place : places)
      visit_node(on_panel(a_, x, place.a_1, place.a_2, place.weight), on_panel(b_, y, place.b_1, place.b_2, 1));
  }
  /// A place on a panel, whose weight is without the panel's Jacobian.
  struct OnPanel {
    double u, v, weight;
  };
  static OnPanel on_panel(const scene::SurfacePatch& panel, const Triangle& part, double u, double v, double weight) {
    const mesh::ElementPoint at = mesh::coordinates_in(panel, {0}, part.at(u, v));
    return {at.u, at.v, weight * part.doubled_area() / jacobian(panel.ring(), at.u, at.v)};
  }
  void visit_node(const OnPanel& x, const OnPanel& y) { visit_({x.u, x.v, y.u, y.v, x.weight * y.weight}); }

  struct Apart {
    Triangle x, y;
    double distance;  ///< from middle to middle, over the sum of the radii
  };
  std::vector<Apart> apart_;
  const TrianglePairPlaces& places_;
  const PairRule::Visit& visit_;
  const Panel &panel_a_, &panel_b_;
  scene::SurfacePatch a_, b_;
  double near_ = 0;
};

std::vector<Place> edge_places(const Rule& line) {
  const Rule exact = gauss_legendre(points_of_polynomials);
  std::vector<Place> places;
  // x at (z, s), y at (z + w, t), w >= 0; and swapped.
  const auto add = [&](double z, double w, double s, double t, double weight) {
    places.push_back({z, s, z + w, t, weight});
    places.push_back({z + w, t, z, s, weight});
  };
  for (const RuleNode& xi : exact)
    for (const RuleNode& along : exact)
      for (const RuleNode& k : line)
        for (const RuleNode& l : line) {
          const double z = (1 - xi.u) * along.u,
                       weight = xi.weight * along.weight * k.weight * l.weight * xi.u * xi.u * (1 - xi.u);
          add(z, xi.u * k.u * l.u, xi.u, xi.u * k.u * (1 - l.u), weight * k.u);  // s = xi
          add(z, xi.u * l.u, xi.u * k.u, xi.u * (1 - l.u), weight);              // t + w = xi
        }
  return places;
}

std::vector<Place> corner_places(const Rule& line) {
  std::vector<Place> places;
  for (const RuleNode& a : gauss_legendre(points_of_polynomials))
    for (const RuleNode& tau : line)
      for (const RuleNode& k : line)
        for (const RuleNode& l : line) {
          const double b = a.u * tau.u, weight = a.weight * tau.weight * k.weight * l.weight * a.u * a.u * b;
          places.push_back({a.u * (1 - k.u), a.u * k.u, b * (1 - l.u), b * l.u, weight});
          places.push_back({b * (1 - k.u), b * k.u, a.u * (1 - l.u), a.u * l.u, weight});
        }
  return places;
}

/// (u, v) -> (u (1 - v), v), whose Jacobian is 1 - v.
Rule on_triangle(const Rule& line) {
  Rule triangle;
  for (const RuleNode& u : line)
    for (const RuleNode& v : line) triangle.push_back({u.u * (1 - v.u), v.u, u.weight * v.weight * (1 - v.u)});
  return triangle;
}

}  // namespace

TrianglePairPlaces::TrianglePairPlaces(int points) {
  const Rule line = gauss_legendre(points);
  edge = edge_places(line);
  corner = corner_places(line);
  // At the least distance rho is above 3.7: half as many points leave less than all do where triangles touch.
  for (int n = 1; n <= std::min((points + 1) / 2, most_points_apart); ++n)
    apart.push_back(on_triangle(gauss_legendre(n)));
}

PolygonPairRule::PolygonPairRule(int points) : places_(points) {}

void PolygonPairRule::for_nodes(const Panel& a, const Panel& b, const Visit& visit) const {
  if (a.corners < 3 || b.corners < 3) throw core::PreconditionError("PolygonPairRule: triangles and quads expected");
  PolygonPairNodes(places_, a, b, visit).visit();
}

}  // namespace interflect::fem

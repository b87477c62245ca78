#pragma once

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "fem/form_factor/moment_integrand.h"
#include "fem/quadrature.h"

namespace interflect::fem::test {

/// An element and its functions: what a reference integral is of.
struct TouchingElement {
  std::vector<Vec3> ring;  ///< convex, with the common point among its corners, be it in the middle of an edge
  Vec3 normal;
  const PlaneBasis& basis;
  Vec3 origin;  ///< of the basis
};

/// Blocks of K of elements that touch in a point or along an edge from that point on, by a way of their own: both are
/// cut into triangles about the point, and the kernel
///
///   k(d) = -(n_x . d) (n_y . d) / (pi |d|^4),   d = y - x,   k(rho d) = k(d) / rho²
///
/// is taken apart from its singularity by homogeneous coordinates, after which Gauss rules converge exponentially:
///
/// - triangles with one common corner p: x = p + rho X, y = p + rho Y; either X is on the edge opposite to p and Y
///   anywhere in the other triangle, or the other way round.  dx dy = rho³ d(X, Y), so that rho k is left, and
///   polynomials of rho;
/// - triangles with a common edge e: x = p + s e + a f, y = p + t e + b g, z = s - t.  d depends on (z, a, b) alone;
///   what is integrated over s at constant z is a polynomial between bounds that are linear in (z, a, b):
///   of z > 0, s from z to 1 - a where z + a > b, and to 1 + z - b elsewhere; z < 0 is the same of the triangles
///   swapped. (z, a, b) = rho times a point where max(z + a, b) = 1, so that rho² k is left without a singularity.
///
/// rho and s are integrated exactly, by order + 1 Gauss points; the others by `points` each.
/// Source: [Sauter, Schwab 2011], 5.2.
class TouchingMoments {
 public:
  TouchingMoments(int order, int points) : of_polynomials_(gauss_legendre(order + 1)), rule_(gauss_legendre(points)) {}

  /// @param common  a corner of both
  Moments operator()(const TouchingElement& x, const TouchingElement& y, const Vec3& common) const {
    Moments sum = Moments::Zero(x.basis.size(), y.basis.size());
    for (const Triangle& a : fan(x.ring, common))
      for (const Triangle& b : fan(y.ring, common)) {
        if (a.q == b.q || a.q == b.r || a.r == b.q || a.r == b.r)
          sum += with_edge(x, edge_first(a, b), y, edge_first(b, a));
        else
          sum += with_corner(x, a, y, b);
      }
    return sum;
  }

 private:
  struct Triangle {
    Vec3 p, q, r;  ///< p is the common point
    double doubled_area() const { return (q - p).cross(r - p).norm(); }
  };
  static std::vector<Triangle> fan(const std::vector<Vec3>& ring, const Vec3& about) {
    const auto n = ring.size();
    const auto first = static_cast<std::size_t>(std::find(ring.begin(), ring.end(), about) - ring.begin());
    if (first == n) throw std::logic_error("not a corner");
    std::vector<Triangle> triangles;
    for (std::size_t k = 1; k + 1 < n; ++k)
      triangles.push_back({about, ring[(first + k) % n], ring[(first + k + 1) % n]});
    return triangles;
  }
  /// The same, q being the other end of the common edge.
  static Triangle edge_first(const Triangle& of, const Triangle& other) {
    const bool q_is_common = of.q == other.q || of.q == other.r;
    return q_is_common ? of : Triangle{of.p, of.r, of.q};
  }

  static double kernel(const TouchingElement& x, const TouchingElement& y, const Vec3& d) {
    const double square = d.squaredNorm();
    return -x.normal.dot(d) * y.normal.dot(d) / (pi * square * square);
  }

  Moments with_corner(const TouchingElement& x, const Triangle& a, const TouchingElement& y, const Triangle& b) const {
    return half_with_corner(x, a, y, b) + half_with_corner(y, b, x, a).transpose();
  }
  /// Of X on the edge opposite to p.
  Moments half_with_corner(const TouchingElement& x, const Triangle& a, const TouchingElement& y,
                           const Triangle& b) const {
    Moments sum = Moments::Zero(x.basis.size(), y.basis.size());
    const double areas = a.doubled_area() * b.doubled_area();
    for (const RuleNode& along : rule_) {
      const Vec3 X = (1 - along.u) * (a.q - a.p) + along.u * (a.r - a.p);
      for (const RuleNode& rho : of_polynomials_) {
        PlaneBasis::Values of_y = PlaneBasis::Values::Zero(y.basis.size());
        for (const RuleNode& out : rule_)
          for (const RuleNode& across : rule_) {
            const Vec3 Y = out.u * ((1 - across.u) * (b.q - b.p) + across.u * (b.r - b.p));
            of_y += out.weight * out.u * across.weight * kernel(x, y, Y - X) * y.basis.at(b.p + rho.u * Y - y.origin);
          }
        const double weight = areas * along.weight * rho.weight * rho.u;
        sum += weight * x.basis.at(a.p + rho.u * X - x.origin) * of_y.transpose();
      }
    }
    return sum;
  }

  Moments with_edge(const TouchingElement& x, const Triangle& a, const TouchingElement& y, const Triangle& b) const {
    return half_with_edge(x, a, y, b) + half_with_edge(y, b, x, a).transpose();
  }
  /// Of z > 0.
  Moments half_with_edge(const TouchingElement& x, const Triangle& a, const TouchingElement& y,
                         const Triangle& b) const {
    Moments sum = Moments::Zero(x.basis.size(), y.basis.size());
    const Vec3 e = a.q - a.p, f = a.r - a.p, g = b.r - b.p;
    const double areas = a.doubled_area() * b.doubled_area();
    // At a point (z, a, b) of the unit faces, whose weight is w.
    const auto along_rho = [&](double z, double of_f, double of_g, double w) {
      const double weight = areas * w * kernel(x, y, of_g * g - of_f * f - z * e);
      for (const RuleNode& rho : of_polynomials_) {
        const double from = rho.u * z, length = 1 - rho.u * std::max(z + of_f, of_g);
        for (const RuleNode& part : of_polynomials_) {
          const double s = from + part.u * length, t = s - rho.u * z;
          sum += weight * rho.weight * part.weight * length * x.basis.at(a.p + s * e + rho.u * of_f * f - x.origin) *
                 y.basis.at(b.p + t * e + rho.u * of_g * g - y.origin).transpose();
        }
      }
    };
    for (const RuleNode& k : rule_)
      for (const RuleNode& l : rule_) {
        along_rho(1 - k.u, k.u, l.u, k.weight * l.weight);
        along_rho(l.u * (1 - k.u), l.u * k.u, 1, k.weight * l.weight * l.u);
      }
    return sum;
  }

  Rule of_polynomials_, rule_;
};

}  // namespace interflect::fem::test

#include "fem/form_factor/distant_emitter.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "fem/quadrature.h"
#include "fem/space/polynomials.h"

namespace interflect::fem {
namespace {

constexpr std::size_t most_triangles = 14;

/// Degrees 2, 4, 6, 8.
const Rule& rule_of(std::size_t step) {
  static const std::array<Rule, 4> rules{triangle_rule(2), triangle_rule(4), triangle_rule(6), triangle_rule(8)};
  return rules[step];
}

/// Of the first term that a rule of that degree misses.
double missed(int degree, int order, double s) {
  const int n = degree - order;
  if (n <= 0) return 1;
  double power = (n + 1) * (n + 2) * (n + 3) / 6.0;
  for (int k = 0; k < n; ++k) power *= s;
  return power;
}

/// The cheapest rule that will do; nullptr where none does.
const Rule* rule_for(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& x, int order, double accuracy) {
  const Vec3 middle = (a + b + c) / 3.0;
  const double radius2 = std::max({(a - middle).squaredNorm(), (b - middle).squaredNorm(), (c - middle).squaredNorm()}),
               s = std::sqrt(radius2 / (middle - x).squaredNorm());
  for (std::size_t step = 0; step < 4; ++step)
    if (missed(2 * static_cast<int>(step) + 2, order, s) <= accuracy) return &rule_of(step);
  return nullptr;
}

}  // namespace

bool distant_monomials(const Vec3& x, const Vec3& n, std::span<const Vec3> polygon, const PlaneFrame& frame, int order,
                       double accuracy, std::span<double> out) {
  if (polygon.size() < 3 || polygon.size() > most_triangles + 2) return false;
  std::array<const Rule*, most_triangles> rules;
  for (std::size_t k = 2; k < polygon.size(); ++k) {
    rules[k - 2] = rule_for(polygon[0], polygon[k - 1], polygon[k], x, order, accuracy);
    if (rules[k - 2] == nullptr) return false;
  }
  const auto count = static_cast<std::size_t>(plane_functions(order));
  std::fill_n(out.begin(), count, 0.0);
  const double h = frame.e_1.cross(frame.e_2).dot(x - frame.origin);
  if (!(h > 0)) return true;
  std::array<double, PlaneBasis::most_functions> values{1};
  for (std::size_t k = 2; k < polygon.size(); ++k) {
    const Vec3 &a = polygon[0], u = polygon[k - 1] - a, v = polygon[k] - a;
    const double scale = 0.5 * u.cross(v).norm() * h * inv_pi;
    for (const RuleNode& node : *rules[k - 2]) {
      const Vec3 y = a + node.u * u + node.v * v, r = y - x, to = y - frame.origin;
      const double square = r.squaredNorm(), weight = node.weight * scale * n.dot(r) / (square * square);
      if (order > 0) monomials(order, frame.e_1.dot(to), frame.e_2.dot(to), {values.data(), count});
      for (std::size_t m = 0; m < count; ++m) out[m] += weight * values[m];
    }
  }
  return true;
}

}  // namespace interflect::fem

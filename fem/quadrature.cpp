#include "fem/quadrature.h"

#include <cmath>

#include "core/error.h"

namespace interflect::fem {

namespace {

/// P_n(x) and P_n'(x) by the three-term recurrence.
std::pair<double, double> legendre(int n, double x) {
  double previous = 1.0, value = x;
  for (int k = 2; k <= n; ++k) {
    const double next = ((2.0 * k - 1.0) * x * value - (k - 1.0) * previous) / k;
    previous = value;
    value = next;
  }
  return {value, n * (x * value - previous) / (x * x - 1.0)};
}

void add_centroid(Rule& rule, double weight) { rule.push_back({1.0 / 3.0, 1.0 / 3.0, weight}); }

/// The three nodes with barycentric coordinates (a, a, 1 - 2a).
void add_three(Rule& rule, double a, double weight) {
  const double b = 1.0 - 2.0 * a;
  rule.insert(rule.end(), {{a, a, weight}, {a, b, weight}, {b, a, weight}});
}

/// The six nodes with barycentric coordinates (a, b, 1 - a - b).
void add_six(Rule& rule, double a, double b, double weight) {
  const double c = 1.0 - a - b;
  rule.insert(rule.end(),
              {{a, b, weight}, {b, a, weight}, {a, c, weight}, {c, a, weight}, {b, c, weight}, {c, b, weight}});
}

Rule triangle_rule_12() {
  Rule rule;
  add_three(rule, 0.249286745170910, 0.116786275726379);
  add_three(rule, 0.063089014491502, 0.050844906370207);
  add_six(rule, 0.053145049844817, 0.310352451033784, 0.082851075618374);
  return rule;
}

Rule triangle_rule_16() {
  Rule rule;
  add_centroid(rule, 0.144315607677787);
  add_three(rule, 0.459292588292723, 0.095091634267285);
  add_three(rule, 0.170569307751760, 0.103217370534718);
  add_three(rule, 0.050547228317031, 0.032458497623198);
  add_six(rule, 0.008394777409958, 0.263112829634638, 0.027230314174435);
  return rule;
}

}  // namespace

Rule gauss_legendre(int points) {
  if (points < 1) throw core::PreconditionError("gauss_legendre: at least one point expected");
  Rule rule(static_cast<std::size_t>(points));
  for (int k = 0; k < points; ++k) {
    double x = std::cos(pi * (k + 0.75) / (points + 0.5));
    if (2 * k + 1 == points) x = 0.0;  // the middle node, where the starting value is right but for rounding
    double slope = 1.0;
    for (int step = 0; step < 8 && points > 1; ++step) {
      const auto [value, derivative] = legendre(points, x);
      slope = derivative;
      x -= value / derivative;
    }
    const double weight = points == 1 ? 1.0 : 1.0 / ((1.0 - x * x) * slope * slope);
    rule[static_cast<std::size_t>(points - 1 - k)] = {0.5 * (1.0 + x), 0.0, weight};
  }
  return rule;
}

Rule quad_rule(int points) {
  const Rule line = gauss_legendre(points);
  Rule rule;
  for (const RuleNode& a : line)
    for (const RuleNode& b : line) rule.push_back({a.u, b.u, a.weight * b.weight});
  return rule;
}

Rule closed_triangle_rule() {
  Rule rule;
  add_centroid(rule, 9.0 / 20.0);
  add_three(rule, 0.5, 2.0 / 15.0);
  add_three(rule, 0.0, 1.0 / 20.0);
  return rule;
}

Rule closed_quad_rule() {
  Rule rule;
  for (const double u : {0.5, 0.0, 1.0})
    for (const double v : {0.5, 0.0, 1.0})
      rule.push_back({u, v, (u == 0.5 ? 4.0 : 1.0) * (v == 0.5 ? 4.0 : 1.0) / 36.0});
  return rule;
}

Rule triangle_rule(int degree) {
  if (degree < 0 || degree > 8) throw core::PreconditionError("triangle_rule: a degree of 0 .. 8 expected");
  Rule rule;
  if (degree <= 1) {
    add_centroid(rule, 1.0);
  } else if (degree == 2) {
    add_three(rule, 1.0 / 6.0, 1.0 / 3.0);
  } else if (degree <= 4) {
    add_three(rule, 0.445948490915965, 0.223381589678011);
    add_three(rule, 0.091576213509771, 0.109951743655322);
  } else if (degree == 5) {
    add_centroid(rule, 0.225);
    add_three(rule, 0.470142064105115, 0.132394152788506);
    add_three(rule, 0.101286507323456, 0.125939180544827);
  } else {
    rule = degree == 6 ? triangle_rule_12() : triangle_rule_16();
  }
  double sum = 0.0;
  for (const RuleNode& node : rule) sum += node.weight;
  for (RuleNode& node : rule) node.weight /= sum;  // the tables carry 15 digits: areas should carry 16
  return rule;
}

RulePair rules_of(int points) {
  static constexpr int degree[] = {1, 4, 6, 8};
  if (points < 1 || points > 4) throw core::PreconditionError("rules_of: 1 .. 4 points expected");
  return {triangle_rule(degree[points - 1]), quad_rule(points)};
}

Vec3 point_on(std::span<const Vec3> ring, double u, double v) {
  if (ring.size() == 2) return ring[0] + u * (ring[1] - ring[0]);
  if (ring.size() == 3) return ring[0] + u * (ring[1] - ring[0]) + v * (ring[2] - ring[0]);
  const Vec3 along_u = ring[1] - ring[0], along_v = ring[3] - ring[0];
  return ring[0] + u * along_u + v * along_v + (u * v) * ((ring[2] - ring[1]) - along_v);
}

double jacobian(std::span<const Vec3> ring, double u, double v) {
  const Vec3 along_u = ring[1] - ring[0];
  if (ring.size() == 2) return along_u.norm();
  if (ring.size() == 3) return along_u.cross(ring[2] - ring[0]).norm();
  const Vec3 along_v = ring[3] - ring[0], twist = (ring[2] - ring[1]) - along_v;
  return (along_u + v * twist).cross(along_v + u * twist).norm();
}

void append_nodes(std::span<const Vec3> ring, const Rule& rule, std::vector<SurfaceNode>& out) {
  const double scale = ring.size() == 3 ? 0.5 : 1.0;
  for (const RuleNode& node : rule)
    out.push_back({point_on(ring, node.u, node.v), scale * jacobian(ring, node.u, node.v) * node.weight});
}

}  // namespace interflect::fem

#include "fem/pair_rule.h"

#include "core/error.h"

namespace interflect::fem {

namespace {

/// Corners closer than this, beside the panels' size, are one.
constexpr double same_place = 1e-12;

std::vector<PairNode> product(const Rule& rule) {
  std::vector<PairNode> nodes;
  for (const RuleNode& a : rule)
    for (const RuleNode& b : rule) nodes.push_back({a.u, 0, b.u, 0, a.weight * b.weight});
  return nodes;
}

void require_segments(const Panel& a, const Panel& b) {
  if (a.corners != 2 || b.corners != 2) throw core::PreconditionError("PairRule: segments expected");
}

}  // namespace

ProductPairRule::ProductPairRule(int points) : segments_(product(gauss_legendre(points))) {}

void ProductPairRule::for_nodes(const Panel& a, const Panel& b, const Visit& visit) const {
  require_segments(a, b);
  for (const PairNode& node : segments_) visit(node);
}

SegmentPairRule::SegmentPairRule(int points) : apart_(points) {
  const Rule rule = gauss_legendre(points);
  for (const RuleNode& s : rule)
    for (const RuleNode& e : rule) {
      touching_.push_back({s.u, 0, s.u * e.u, 0, s.weight * e.weight * s.u});
      touching_.push_back({s.u * e.u, 0, s.u, 0, s.weight * e.weight * s.u});
    }
}

void SegmentPairRule::for_nodes(const Panel& a, const Panel& b, const Visit& visit) const {
  require_segments(a, b);
  for (const std::size_t end_a : {0u, 1u})
    for (const std::size_t end_b : {0u, 1u}) {
      if ((a.corner[end_a] - b.corner[end_b]).norm() > same_place * (a.measure + b.measure)) continue;
      for (PairNode node : touching_) {
        if (end_a == 1) node.u_a = 1 - node.u_a;
        if (end_b == 1) node.u_b = 1 - node.u_b;
        visit(node);
      }
      return;
    }
  apart_.for_nodes(a, b, visit);
}

}  // namespace interflect::fem

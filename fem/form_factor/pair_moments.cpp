#include "fem/form_factor/pair_moments.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fem/form_factor/adaptive_cells.h"
#include "fem/form_factor/far_field.h"
#include "fem/kernel.h"
#include "geometry/segment.h"

namespace interflect::fem {
namespace {

constexpr int most_points = MomentIntegrator::most_points;
constexpr Index most_nodes = (most_points + 1) * (most_points + 1);
constexpr double farthest_reach = 1.2;  ///< radii over distance, up to which a product rule is tried
constexpr std::size_t most_cells = 4000;
/// From corners of one element to the other, its sides or its inside [m].
double corners_to(const ElementShape& from, const ElementShape& to) {
  double distance = std::numeric_limits<double>::infinity();
  for (const Vec3& x : from.ring()) {
    bool inside = true;
    for (std::size_t k = 0; k < to.corners; ++k) {
      const Vec3 &p = to.corner[k], &q = to.corner[(k + 1) % to.corners];
      distance = std::min(distance, geometry::distance_to_segment(x, p, q));
      inside = inside && to.plane.normal.dot((q - p).cross(x - p)) > 0;
    }
    if (inside) distance = std::min(distance, std::abs(to.plane.distance(x)));
  }
  return distance;
}

/// What is left of the difference to a rule with one node a side less.  On an interval of half length h whose kernel is
/// singular at the distance d, one node more leaves rho^-2 with rho = 1 + d / h + sqrt((1 + d / h)² - 1) of Bernstein's
/// ellipse [Trefethen 2008]; the factors before it are fitted.
double left_by_a_step(const ElementShape& a, const ElementShape& b, int order) {
  double longest = 0;
  for (const ElementShape* shape : {&a, &b})
    for (std::size_t k = 0; k < shape->axis_count; ++k) longest = std::max(longest, shape->axis[k].length);
  const double x = 1 + std::min(corners_to(a, b), corners_to(b, a)) / longest, rho = x + std::sqrt(x * x - 1);
  const bool any_triangle = a.corners == 3 || b.corners == 3;
  return (any_triangle ? (order == 3 ? 24 : 20) : 8) / (rho * rho);
}

/// Nodes of a part of an element, with the whole one's functions there.
struct FunctionNodes {
  FunctionNodes(const ElementShape& shape, const PlaneBasis& basis, const Rule& rule) {
    append_nodes(shape.ring(), rule, nodes);
    weighed.resize(basis.size(), std::ssize(nodes));
    for (std::size_t k = 0; k < nodes.size(); ++k)
      weighed.col(static_cast<Index>(k)) = nodes[k].weight * basis.at(nodes[k].position);
  }
  std::vector<SurfaceNode> nodes;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, PlaneBasis::most_functions, most_nodes> weighed;
};

/// Of n Gauss nodes a side.  On triangles, beyond the symmetric ones, of n + 1 as products in (u / (1 - v), v), whose
/// Jacobian takes one degree: degree 2n.
RulePair rules_with(int points) {
  if (points <= 4) return rules_of(points);
  RulePair rules{{}, quad_rule(points)};
  double sum = 0;
  for (const RuleNode& node : quad_rule(points + 1)) {
    rules.triangle.push_back({node.u * (1 - node.v), node.v, node.weight * (1 - node.v)});
    sum += rules.triangle.back().weight;
  }
  for (RuleNode& node : rules.triangle) node.weight /= sum;
  return rules;
}

/// Of the whole inner element, or of a clipped one.
struct WholeIntegrand : MomentIntegrand {
  WholeIntegrand(const MomentIntegrand& of, std::span<const Vec3> ring) : MomentIntegrand(of), inner(ring) {}
  std::span<const Vec3> inner;
  Value at(const Vec3& x) const { return at_whole(x, inner); }
};

/// Of the closed form's monomials about the foot, which cancel where that is far from the inner element.
double rounding_of(const ElementShape& outer, const PlaneBasis& of_outer, const ElementShape& inner,
                   const PlaneBasis& of_inner) {
  constexpr double of_closed_form = 1e-14;
  const double reach = (outer.centroid - inner.centroid).norm() + outer.radius + inner.radius;
  return of_closed_form * outer.area * of_outer.largest() * std::pow(reach / inner.radius, of_inner.order());
}

PairMoments near(const ElementShape& outer, const PlaneBasis& of_outer, const ElementShape& inner,
                 const PlaneBasis& of_inner, double tolerance) {
  const double accuracy = 0.1 * tolerance / (outer.area * of_outer.largest());
  const WholeIntegrand integrand(MomentIntegrand(of_outer, outer.plane.normal, of_inner, accuracy), inner.ring());
  AdaptiveCells<WholeIntegrand> cells(integrand, inner.ring(), cell_scheme(tolerance / outer.area));
  cells.cover(outer.ring());
  while (cells.error() > tolerance && cells.cells() < most_cells) cells.cut_worst();
  const auto [value, error] = cells.result();
  return {value, error + 0.1 * tolerance + rounding_of(outer, of_outer, inner, of_inner)};
}

}  // namespace

int pair_degree(const FormFactorContext& context, Index i, Index j) {
  if (context.degrees.empty()) return context.order;
  return std::max(context.degrees[static_cast<std::size_t>(i)], context.degrees[static_cast<std::size_t>(j)]);
}

void write_block(Index i, Index j, Index stride, const PairMoments& block, double standard_error, ExchangeSink& sink) {
  for (Index a = 0; a < block.value.rows(); ++a)
    for (Index b = 0; b < block.value.cols(); ++b)
      sink.add(i * stride + a, j * stride + b, {block.value(a, b), standard_error, block.error});
}

MomentIntegrator::MomentIntegrator(const ElementShapes& shapes, int order, double tolerance)
    : shapes_(shapes), order_(order), tolerance_(tolerance) {
  for (int points = 1; points <= most_points; ++points)
    rules_[static_cast<std::size_t>(points - 1)] = rules_with(points);
  for (Index i = 0; i < shapes.size(); ++i) bases_.emplace_back(order, shapes[i].ring(), shapes[i].plane.normal);
}

Moments MomentIntegrator::by_products(Index i, const ElementShape& a, Index j, const ElementShape& b,
                                      int points) const {
  const RulePair& rules = rules_[static_cast<std::size_t>(points - 1)];
  const FunctionNodes of_a(a, basis(i), rules.of(a.corners)), of_b(b, basis(j), rules.of(b.corners));
  const SpaceKernel kernel;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most_nodes, most_nodes> k(std::ssize(of_a.nodes),
                                                                                     std::ssize(of_b.nodes));
  for (Index p = 0; p < k.rows(); ++p)
    for (Index q = 0; q < k.cols(); ++q)
      k(p, q) = kernel(of_a.nodes[static_cast<std::size_t>(p)].position, a.plane.normal,
                       of_b.nodes[static_cast<std::size_t>(q)].position, b.plane.normal);
  return of_a.weighed * k * of_b.weighed.transpose();
}

std::optional<PairMoments> MomentIntegrator::far(Index i, const ElementShape& a, Index j, const ElementShape& b,
                                                 double tolerance) const {
  const FarPair pair = far_pair(a, b);
  if (!(pair.q < farthest_reach)) return std::nullopt;
  const auto of_constants = far_rule(pair, tolerance_);
  const double left = left_by_a_step(a, b, order_);
  int points = std::max(2, (of_constants ? of_constants->level + 1 : ElementShapes::levels) + (order_ + 1) / 2);
  PairMoments block{by_products(i, a, j, b, points - 1), 0};
  for (; points <= most_points; ++points) {
    Moments finer = by_products(i, a, j, b, points);
    block.error = left * (finer - block.value).cwiseAbs().maxCoeff();
    block.value = std::move(finer);
    if (block.error <= tolerance) return block;
  }
  return std::nullopt;
}

PairMoments MomentIntegrator::unclipped(Index i, const ElementShape& a, Index j, const ElementShape& b,
                                        double tolerance) const {
  if (auto block = far(i, a, j, b, tolerance)) return *block;
  if (a.radius <= b.radius) return near(a, basis(i), b, basis(j), tolerance);
  PairMoments block = near(b, basis(j), a, basis(i), tolerance);
  block.value = block.value.transpose().eval();
  return block;
}

PairMoments MomentIntegrator::operator()(Index i, Index j, const PairIntegral& constants) const {
  const ElementShape &a = shapes_[i], &b = shapes_[j];
  const double tolerance = tolerance_ * constants.value;
  if (constants.facing == Facing::full) return unclipped(i, a, j, b, tolerance);
  const Pieces of_a = pieces_in_front(a, b.plane), of_b = pieces_in_front(b, a.plane);
  const double share = tolerance / static_cast<double>(of_a.count * of_b.count);
  PairMoments sum{Moments::Zero(basis(i).size(), basis(j).size()), 0};
  for (std::size_t k = 0; k < of_a.count; ++k)
    for (std::size_t l = 0; l < of_b.count; ++l) {
      const PairMoments part = unclipped(i, of_a.shape[k], j, of_b.shape[l], share);
      sum.value += part.value;
      sum.error += part.error;
    }
  return sum;
}

}  // namespace interflect::fem

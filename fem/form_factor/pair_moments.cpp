#include "fem/form_factor/pair_moments.h"

#include <algorithm>
#include <cmath>

#include "fem/form_factor/adaptive_cells.h"
#include "fem/form_factor/far_field.h"
#include "fem/kernel.h"

namespace interflect::fem {
namespace {

constexpr int most_points = 4;  ///< a side, of rules_of
constexpr std::size_t most_cells = 4000;
/// Of the difference to a rule with one node a side less, times the square of the reach: fitted.
double left_by_a_step(const FarPair& pair, int order) {
  const bool any_triangle = pair.triangles[0] || pair.triangles[1];
  return any_triangle ? (order == 3 ? 6 : 4) : 2;
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
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, PlaneBasis::most_functions, 16> weighed;
};

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
  const WholeIntegrand integrand(MomentIntegrand(of_outer, outer.plane.normal, of_inner), inner.ring());
  AdaptiveCells<WholeIntegrand> cells(integrand, inner.ring(), cell_scheme(tolerance / outer.area));
  cells.cover(outer.ring());
  while (cells.error() > tolerance && cells.cells() < most_cells) cells.cut_worst();
  const auto [value, error] = cells.result();
  return {value, error + rounding_of(outer, of_outer, inner, of_inner)};
}

}  // namespace

MomentIntegrator::MomentIntegrator(const ElementShapes& shapes, int order, double tolerance)
    : shapes_(shapes), order_(order), tolerance_(tolerance) {
  for (Index i = 0; i < shapes.size(); ++i) bases_.emplace_back(order, shapes[i].ring(), shapes[i].plane.normal);
}

Moments MomentIntegrator::by_products(Index i, const ElementShape& a, Index j, const ElementShape& b,
                                      int points) const {
  const RulePair& rules = shapes_.rules(points - 1);
  const FunctionNodes of_a(a, basis(i), rules.of(a.corners)), of_b(b, basis(j), rules.of(b.corners));
  const SpaceKernel kernel;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 16, 16> k(std::ssize(of_a.nodes), std::ssize(of_b.nodes));
  for (Index p = 0; p < k.rows(); ++p)
    for (Index q = 0; q < k.cols(); ++q)
      k(p, q) = kernel(of_a.nodes[static_cast<std::size_t>(p)].position, a.plane.normal,
                       of_b.nodes[static_cast<std::size_t>(q)].position, b.plane.normal);
  return of_a.weighed * k * of_b.weighed.transpose();
}

std::optional<PairMoments> MomentIntegrator::far(Index i, const ElementShape& a, Index j, const ElementShape& b,
                                                 double tolerance) const {
  const FarPair pair = far_pair(a, b);
  const auto rule = far_rule(pair, tolerance_);
  if (!rule) return std::nullopt;
  const double reach =
      *std::max_element(pair.reach.begin(), pair.reach.begin() + static_cast<std::ptrdiff_t>(pair.count));
  int points = std::clamp(rule->level + 1 + (order_ + 1) / 2, 2, most_points);
  PairMoments block{by_products(i, a, j, b, points - 1), 0};
  for (; points <= most_points; ++points) {
    Moments finer = by_products(i, a, j, b, points);
    block.error = left_by_a_step(pair, order_) * reach * reach * (finer - block.value).cwiseAbs().maxCoeff();
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

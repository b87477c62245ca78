#include "fem/bounds/node_residuals.h"

#include <cmath>

#include "core/error.h"
#include "fem/columns.h"
#include "scene/place.h"

namespace interflect::fem {
namespace {

using solvers::ColumnMatrix;
using Row = Eigen::RowVectorXd;

bool inside(const Cell& cell, const Vec3& x) {
  for (std::size_t k = 0; k < cell.ring.size(); ++k) {
    const Vec3& from = cell.ring[k];
    if (cell.normal.dot((cell.ring[(k + 1) % cell.ring.size()] - from).cross(x - from)) < 0) return false;
  }
  return true;
}
/// Of quarters of quarters of one cell.
bool holds(const Cell& a, const Cell& b) { return b.area <= a.area * (1 + 1e-9) && inside(a, b.centre); }

/// Black elements have none.
ColumnMatrix with_black_ones(std::span<const Spectrum> values, const LinearField& b) {
  ColumnMatrix columns = ColumnMatrix::Zero(b.elements(), b.channels());
  columns.topRows(std::ssize(values)) = to_columns(values, static_cast<int>(b.channels()));
  return columns;
}

}  // namespace

NodeResiduals::NodeResiduals(const LinearField& b, const RadiositySolution& solution)
    : b_(b),
      exitance_(with_black_ones(solution.exitance, b)),
      reflectance_(with_black_ones(solution.reflectance, b)),
      everywhere_(b.elements() * QuarterTree::nodes, b.channels()),
      mean_(everywhere_),
      deviation_(ColumnMatrix::Zero(b.elements() * QuarterTree::nodes, b.channels())),
      covers_(solution.mesh.patches().size()) {
  const Index first_black = std::ssize(covers_) * QuarterTree::nodes;
  for (Index row = first_black; row < everywhere_.lower.rows(); ++row) {
    everywhere_.narrow(row, Bounds::zero(b.channels()));
    mean_.narrow(row, Bounds::zero(b.channels()));
  }
}

Bounds NodeResiduals::over(Index element, const Cell& part, SmoothSum TB) const {
  TB.scale(reflectance_.row(element));
  TB.value += exitance_.row(element) - b_.at(element, part.centre);
  TB.derivatives.topRows<2>() -= b_.gradient(element, part);
  return TB.everywhere(part).widened(rounding());
}
Bounds NodeResiduals::mean_over(Index element, const Cell& part, const Bounds& mean_TB) const {
  const Row others = exitance_.row(element) - b_.at(element, part.centre);
  return (Bounds{others, others} + mean_TB.scaled(reflectance_.row(element))).widened(rounding());
}

void NodeResiduals::find(Index element, const CellTransport& transport) {
  find(element, 0, transport.cell(), transport);
}

void NodeResiduals::find(Index element, int node, const Cell& cell, const CellTransport& transport) {
  Bounds all = Bounds::none(b_.channels()), mean = Bounds::zero(b_.channels());
  std::vector<std::pair<double, Bounds>> parts;  // share, r
  double shares = 0;
  for (std::size_t l = 0; l < transport.leaves.size(); ++l) {
    const Leaf& leaf = transport.leaves[l];
    const Cell& of_leaf = transport.cell_of(leaf);
    if (holds(cell, of_leaf)) {
      parts.emplace_back(of_leaf.area / cell.area, over(element, of_leaf, leaf.polynomial));
      mean = mean + leaf.mean.scaled(Row::Constant(b_.channels(), parts.back().first));
    } else if (holds(of_leaf, cell)) {
      SmoothSum polynomial = leaf.polynomial;
      polynomial.move(of_leaf.local(cell.centre));
      mean = polynomial.mean(cell);
      parts.emplace_back(1.0, over(element, cell, std::move(polynomial)));
    } else {
      continue;
    }
    covers_[static_cast<std::size_t>(element)].push_back({node, l});
    shares += parts.back().first;
    all.widen(parts.back().second);
  }
  if (std::abs(shares - 1) > 1e-9) throw core::PreconditionError("enclose: leaves that do not cover their element");
  const Index row = element * QuarterTree::nodes + node;
  const Bounds mean_r = mean_over(element, cell, mean);
  everywhere_.narrow(row, all);
  mean_.narrow(row, mean_r);
  Row deviation = Row::Zero(b_.channels());
  for (const auto& [share, r] : parts) deviation += share * (r.upper - mean_r.lower).cwiseMax(mean_r.upper - r.lower);
  deviation_.row(row) = deviation.cwiseMin(0.5 * (all.upper - all.lower));
  if (!QuarterTree::has(QuarterTree::child(node, 0))) return;
  const auto rings = scene::quarters_of(cell.ring);
  for (int k = 0; k < 4; ++k)
    find(element, QuarterTree::child(node, k),
         cell_of(std::span(rings[static_cast<std::size_t>(k)]).first(cell.ring.size()), cell), transport);
}

}  // namespace interflect::fem

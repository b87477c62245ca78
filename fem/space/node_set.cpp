#include "fem/space/node_set.h"

#include <Eigen/LU>
#include <cmath>

#include "core/error.h"
#include "mesh/shared_corners.h"

namespace interflect::fem {
namespace {

using Triplets = std::vector<Eigen::Triplet<double, Index>>;

void append_block(const Eigen::MatrixXd& block, Index first_row, Index first_column, Triplets& to) {
  for (Index a = 0; a < block.rows(); ++a)
    for (Index b = 0; b < block.cols(); ++b)
      if (block(a, b) != 0) to.emplace_back(first_row + a, first_column + b, block(a, b));
}

NodeSet::Prolongation matrix_of(const Triplets& entries, const Space& space, Index nodes) {
  NodeSet::Prolongation P(space.layout().unknowns(), nodes);
  P.setFromTriplets(entries.begin(), entries.end());
  return P;
}

PanelNodes exact_nodes(const Space& space, Index i) {
  if (space.panel(i).corners == 3) return space.nodes(i, triangle_rule(2 * space.order()));
  return space.nodes(i, space.order() + 1);
}

/// 1/A w_q N_a(x_q): functions x nodes.
Eigen::MatrixXd projection(const PanelNodes& nodes, double measure) {
  const Eigen::Map<const Eigen::VectorXd> w(nodes.weight.data(), std::ssize(nodes.weight));
  return nodes.values.transpose() * (w / measure).asDiagonal();
}

Rule lobatto(int order) {
  const double inner = 0.5 - 0.5 / std::sqrt(5.0);
  switch (order) {
    case 1:
      return {{0, 0, 0}, {1, 0, 0}};
    case 2:
      return {{0, 0, 0}, {0.5, 0, 0}, {1, 0, 0}};
    case 3:
      return {{0, 0, 0}, {inner, 0, 0}, {1 - inner, 0, 0}, {1, 0, 0}};
    default:
      throw core::PreconditionError("end_nodes: an order of 1 or more expected");
  }
}

/// What corners' values are worth at a point: barycentric or bilinear.
Eigen::RowVector4d hats(std::size_t corners, double u, double v) {
  if (corners == 3) return {1 - u - v, u, v, 0};
  return {(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v};
}

/// Coefficients of the corners' hats: functions x corners.
Eigen::MatrixXd coefficients_of_hats(const Space& space, Index i) {
  const Panel& panel = space.panel(i);
  const Rule rule = panel.corners == 3 ? triangle_rule(space.order() + 1) : quad_rule(space.order() + 2);
  const PanelNodes nodes = space.nodes(i, rule);
  Eigen::MatrixXd at_nodes(std::ssize(rule), 4);
  for (Index q = 0; const RuleNode& node : rule) at_nodes.row(q++) = hats(panel.corners, node.u, node.v);
  return projection(nodes, panel.measure) * at_nodes.leftCols(static_cast<Index>(panel.corners));
}

Vec3 middle_of(const Panel& panel) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& corner : panel.ring()) sum += corner;
  return sum / static_cast<double>(panel.corners);
}

}  // namespace

NodeSet gauss_nodes(const Space& space) {
  NodeSet out;
  Triplets entries;
  for (Index i = 0; i < std::ssize(space.panels()); ++i) {
    const PanelNodes nodes = exact_nodes(space, i);
    append_block(projection(nodes, space.panel(i).measure), space.first(i), out.size(), entries);
    out.position.insert(out.position.end(), nodes.position.begin(), nodes.position.end());
    out.panel.resize(out.position.size(), i);
  }
  out.P = matrix_of(entries, space, out.size());
  return out;
}

NodeSet end_nodes(const Space& space) {
  const Rule rule = lobatto(space.order());
  NodeSet out;
  Triplets entries;
  for (Index i = 0; i < std::ssize(space.panels()); ++i) {
    if (space.panel(i).corners != 2) throw core::PreconditionError("end_nodes: segments expected");
    const PanelNodes nodes = space.nodes(i, rule);
    append_block(nodes.values.inverse(), space.first(i), out.size(), entries);
    out.position.insert(out.position.end(), nodes.position.begin(), nodes.position.end());
    out.panel.resize(out.position.size(), i);
  }
  out.P = matrix_of(entries, space, out.size());
  return out;
}

NodeSet corner_nodes(const Space& space, const mesh::ElementMesh& mesh) {
  if (space.order() < 1 || std::ssize(space.panels()) != mesh.size())
    throw core::PreconditionError("corner_nodes: a space of an order from 1 on expected, on the mesh");
  constexpr double inwards = 1e-5;
  const mesh::SharedCorners corners = mesh::shared_corners(mesh);
  NodeSet out;
  for (std::size_t k = 0; k < corners.position.size(); ++k) {
    const auto panel = static_cast<Index>(corners.element[k]);
    out.position.push_back(corners.position[k] + inwards * (middle_of(space.panel(panel)) - corners.position[k]));
    out.panel.push_back(panel);
  }
  Triplets entries;
  for (Index i = 0; i < mesh.size(); ++i) {
    const Eigen::MatrixXd of_hats = coefficients_of_hats(space, i);
    for (Index k = 0; k < of_hats.cols(); ++k)
      for (const auto& [corner, weight] : corners.of[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)])
        append_block(weight * of_hats.col(k), space.first(i), corner, entries);
  }
  out.P = matrix_of(entries, space, out.size());
  return out;
}

}  // namespace interflect::fem

#include "fem/space/space.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace interflect::fem {

Panel panel_of(const scene::SurfacePatch& patch) { return {patch.corner, patch.corners, patch.normal(), patch.area}; }

Panel segment_panel(const Vec3& a, const Vec3& b) {
  const Vec3 along = b - a;
  const double length = along.norm();
  return {{a, b, Vec3::Zero(), Vec3::Zero()}, 2, Vec3(-along.y(), along.x(), 0) / length, length};
}

Space::Space(std::vector<Panel> panels, int order) : order_(order), panels_(std::move(panels)) {
  layout_.first_of_element.push_back(0);
  for (const Panel& panel : panels_) {
    bases_.emplace_back(order, panel.ring());
    layout_.first_of_element.push_back(layout_.unknowns() + bases_.back().size());
    gram_.insert(gram_.end(), static_cast<std::size_t>(bases_.back().size()), panel.measure);
  }
  layout_.owned_end = layout_.unknowns();
}

Space space_on(std::span<const scene::SurfacePatch> patches, int order) {
  std::vector<Panel> panels;
  for (const scene::SurfacePatch& patch : patches) panels.push_back(panel_of(patch));
  return {std::move(panels), order};
}

PanelNodes Space::nodes(Index i, const Rule& rule) const {
  const auto ring = panel(i).ring();
  PanelNodes nodes;
  nodes.values.resize(std::ssize(rule), functions(i));
  std::vector<double> N(static_cast<std::size_t>(functions(i)));
  const double scale = ring.size() == 3 ? 0.5 : 1.0;
  for (Index k = 0; const RuleNode& node : rule) {
    nodes.position.push_back(point_on(ring, node.u, node.v));
    nodes.weight.push_back(scale * jacobian(ring, node.u, node.v) * node.weight);
    basis(i).at(node.u, node.v, N);
    nodes.values.row(k++) = Eigen::Map<const Eigen::RowVectorXd>(N.data(), std::ssize(N));
  }
  return nodes;
}

PanelNodes Space::nodes(Index i, int points) const {
  switch (panel(i).corners) {
    case 2:
      return nodes(i, gauss_legendre(points));
    case 3:
      return nodes(i, rules_of(points).triangle);
    default:
      return nodes(i, quad_rule(points));
  }
}

Eigen::VectorXd Space::project(const Field& f, int points) const {
  Eigen::VectorXd coefficients = Eigen::VectorXd::Zero(layout_.unknowns());
  for (Index i = 0; i < std::ssize(panels_); ++i) {
    const PanelNodes at = nodes(i, points);
    for (std::size_t k = 0; k < at.weight.size(); ++k)
      coefficients.segment(first(i), functions(i)) +=
          at.weight[k] / panel(i).measure * f(i, at.position[k]) * at.values.row(static_cast<Index>(k)).transpose();
  }
  return coefficients;
}

double Space::value(const Eigen::VectorXd& coefficients, Index i, double u, double v) const {
  std::array<double, ElementBasis::most_functions> N;
  basis(i).at(u, v, std::span(N).first(static_cast<std::size_t>(functions(i))));
  return coefficients.segment(first(i), functions(i)).dot(Eigen::Map<const Eigen::VectorXd>(N.data(), functions(i)));
}

double Space::distance(const Eigen::VectorXd& coefficients, const Field& f, int points) const {
  double sum = 0;
  for (Index i = 0; i < std::ssize(panels_); ++i) {
    const PanelNodes at = nodes(i, points);
    const Eigen::VectorXd mine = at.values * coefficients.segment(first(i), functions(i));
    for (std::size_t k = 0; k < at.weight.size(); ++k) {
      const double difference = mine[static_cast<Index>(k)] - f(i, at.position[k]);
      sum += at.weight[k] * difference * difference;
    }
  }
  return std::sqrt(sum);
}

}  // namespace interflect::fem

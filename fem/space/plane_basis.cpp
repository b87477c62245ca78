#include "fem/space/plane_basis.h"

#include <Eigen/QR>
#include <algorithm>
#include <array>

#include "fem/quadrature.h"

namespace interflect::fem {

void monomials(int order, double xi, double eta, std::span<double> out) {
  out[0] = 1;
  for (int degree = 1, first = 0; degree <= order; ++degree) {
    const int next = first + degree;
    for (int j = 0; j < degree; ++j)
      out[static_cast<std::size_t>(next + j)] = xi * out[static_cast<std::size_t>(first + j)];
    out[static_cast<std::size_t>(next + degree)] = eta * out[static_cast<std::size_t>(next - 1)];
    first = next;
  }
}

/// By as many conditions as there are nodes, which polynomials meet exactly.
PlaneBasis::PlaneBasis(int order, std::span<const Vec3> ring, const Vec3& normal) : order_(order) {
  frame_.origin = Vec3::Zero();
  for (const Vec3& x : ring) frame_.origin += x / static_cast<double>(ring.size());
  frame_.e_1 = (ring[1] - ring[0]).normalized();
  frame_.e_2 = normal.cross(frame_.e_1).normalized();
  for (const Vec3& x : ring) radius_ = std::max(radius_, (x - frame_.origin).norm());
  const ElementBasis basis(order, ring);
  const Rule nodes = ring.size() == 3 ? triangle_rule(8) : quad_rule(4);
  const Index n = basis.size();
  Eigen::MatrixXd powers(std::ssize(nodes), n), values(std::ssize(nodes), n);
  std::array<double, most_functions> row;
  const std::span<double> out = std::span(row).first(static_cast<std::size_t>(n));
  for (Index k = 0; const RuleNode& node : nodes) {
    const Vec3 y = (point_on(ring, node.u, node.v) - frame_.origin) / radius_;
    monomials(order, frame_.e_1.dot(y), frame_.e_2.dot(y), out);
    powers.row(k) = Eigen::Map<const Eigen::RowVectorXd>(out.data(), n);
    basis.at(node.u, node.v, out);
    values.row(k++) = Eigen::Map<const Eigen::RowVectorXd>(out.data(), n);
  }
  // Powers across a slender element are small beside those along it: without scales they would be taken for dependent.
  const Eigen::VectorXd scale = powers.colwise().norm().cwiseInverse();
  powers = powers * scale.asDiagonal();
  const Eigen::MatrixXd solved = powers.colPivHouseholderQr().solve(values);
  coefficients_ = (scale.asDiagonal() * solved).transpose();
  largest_ = largest_on(ring);
}

/// sum_ij |C_a,ij| (|xi| / r)^i (|eta| / r)^j with the largest of either coordinate, which is at a corner.
double PlaneBasis::largest_on(std::span<const Vec3> ring) const {
  double xi = 0, eta = 0;
  for (const Vec3& x : ring) {
    const Vec3 from = (x - frame_.origin) / radius_;
    xi = std::max(xi, std::abs(frame_.e_1.dot(from)));
    eta = std::max(eta, std::abs(frame_.e_2.dot(from)));
  }
  std::array<double, most_functions> powers;
  monomials(order_, xi, eta, powers);
  const Values most = coefficients_.cwiseAbs() * Eigen::Map<const Eigen::VectorXd>(powers.data(), size());
  return std::max(1.0, *std::max_element(most.begin(), most.end()));
}

PlaneBasis::Values PlaneBasis::at(const Vec3& y) const {
  std::array<double, most_functions> powers;
  const Vec3 from = (y - frame_.origin) / radius_;
  monomials(order_, frame_.e_1.dot(from), frame_.e_2.dot(from), powers);
  return coefficients_ * Eigen::Map<const Eigen::VectorXd>(powers.data(), size());
}

PlaneBasis::Values PlaneBasis::of_monomials(std::span<const double> integrals) const {
  Values scaled(size());
  double scale = 1;
  for (int degree = 0, at = 0; degree <= order_; ++degree, scale /= radius_)
    for (int j = 0; j <= degree; ++j, ++at) scaled[at] = scale * integrals[static_cast<std::size_t>(at)];
  return coefficients_ * scaled;
}

}  // namespace interflect::fem

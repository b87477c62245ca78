#include "fem/space/element_basis.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <vector>

#include "core/error.h"
#include "fem/quadrature.h"
#include "scene/place.h"

namespace interflect::fem {

namespace {

/// Of coordinates of a quad's plane: a bend below that is rounding.
constexpr double straight = 1e-12;

/// Exact for products of two functions of the highest order, and the Jacobian of a quad.
const Rule& exact_rule(std::size_t corners) {
  static const Rule segment = gauss_legendre(4), triangle = triangle_rule(6), quad = quad_rule(4);
  return corners == 2 ? segment : corners == 3 ? triangle : quad;
}

/// The part of an element that is one of its quarters, or halves.
std::vector<Vec3> quarter_of(std::span<const Vec3> ring, std::size_t quarter) {
  if (ring.size() == 2) {
    const Vec3 middle = 0.5 * (ring[0] + ring[1]);
    return quarter == 0 ? std::vector{ring[0], middle} : std::vector{middle, ring[1]};
  }
  const auto part = scene::quarters_of(ring)[quarter];
  return {part.begin(), part.begin() + std::ssize(ring)};
}

/// (u, v) of the whole at (u, v) of a quarter: bilinear, or affine, like the quarter's corners.
Vec2 in_whole(std::size_t corners, std::size_t quarter, double u, double v) {
  static const std::array<Vec3, 3> triangle{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  static const std::array<Vec3, 4> square{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)};
  if (corners == 2) return {0.5 * (u + static_cast<double>(quarter)), 0};
  const std::span<const Vec3> whole = corners == 3 ? std::span<const Vec3>(triangle) : square;
  return point_on(quarter_of(whole, quarter), u, v).head<2>();
}

}  // namespace

ElementBasis::ElementBasis(int order, std::span<const Vec3> ring) : order_(order), corners_(ring.size()) {
  if (order < 0 || order > highest_order) throw core::PreconditionError("ElementBasis: an order of 0 .. 3 expected");
  if (corners_ < 2 || corners_ > 4) throw core::PreconditionError("ElementBasis: 2, 3 or 4 corners expected");
  if (corners_ != 4 || order == 0) return;
  const Vec3 A = ring[1] - ring[0] + ring[2] - ring[3], B = ring[3] - ring[0] + ring[2] - ring[1],
             W = ring[0] - ring[1] + ring[2] - ring[3], n = A.cross(B);
  bend_u_ = W.cross(B).dot(n) / n.squaredNorm();
  bend_v_ = A.cross(W).dot(n) / n.squaredNorm();
  if (std::max(std::abs(bend_u_), std::abs(bend_v_)) > straight) orthonormalise(ring);
}

void ElementBasis::products_at(double u, double v, std::span<double> out) const {
  const double s = 2 * u - 1, t = 2 * v - 1;
  legendre_products(order_, s + bend_u_ * s * t, t + bend_v_ * s * t, out);
}

/// With the Gram matrix L L^T of the products, L^-1 times them is orthonormal, and keeps their order.
void ElementBasis::orthonormalise(std::span<const Vec3> ring) {
  Matrix gram = Matrix::Zero(size(), size());
  std::array<double, most_functions> values;
  const std::span<double> products = std::span(values).first(static_cast<std::size_t>(size()));
  double area = 0;
  for (const RuleNode& node : exact_rule(4)) {
    products_at(node.u, node.v, products);
    const Eigen::Map<const Eigen::VectorXd> N(products.data(), size());
    const double weight = node.weight * jacobian(ring, node.u, node.v);
    gram += weight * N * N.transpose();
    area += weight;
  }
  inverse_factor_ = (gram / area).llt().matrixL().solve(Matrix::Identity(size(), size()));
}

void ElementBasis::at(double u, double v, std::span<double> out) const {
  if (corners_ == 2) return legendre(2 * u - 1, out);
  if (corners_ == 3) return dubiner(order_, u, v, out);
  products_at(u, v, out);
  if (inverse_factor_.size() == 0) return;
  Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_functions, 1>> N(out.data(), size());
  N = (inverse_factor_.triangularView<Eigen::Lower>() * N).eval();
}

Eigen::MatrixXd restriction(int order, std::span<const Vec3> ring, std::size_t quarter) {
  const std::vector<Vec3> part = quarter_of(ring, quarter);
  const ElementBasis of_whole(order, ring), of_part(order, part);
  Eigen::VectorXd N(of_whole.size()), M(of_part.size());
  Eigen::MatrixXd R = Eigen::MatrixXd::Zero(N.size(), M.size());
  double area = 0;
  for (const RuleNode& node : exact_rule(ring.size())) {
    const Vec2 at = in_whole(ring.size(), quarter, node.u, node.v);
    of_whole.at(at.x(), at.y(), {N.data(), static_cast<std::size_t>(N.size())});
    of_part.at(node.u, node.v, {M.data(), static_cast<std::size_t>(M.size())});
    const double weight = node.weight * jacobian(part, node.u, node.v);
    R += weight * N * M.transpose();
    area += weight;
  }
  return R / area;
}

}  // namespace interflect::fem

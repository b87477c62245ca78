#include "fem/bounds/linear_field.h"

#include <cmath>

#include "fem/columns.h"

namespace interflect::fem {
namespace {

using solvers::ColumnMatrix;

/// Of the polynomials' linear functions, which are N_1 and N_2 whatever the order.
Eigen::Matrix<double, 3, Eigen::Dynamic> gradient_of(const PolynomialField& field, std::size_t element, double size) {
  const PlaneBasis& basis = field.bases[element];
  const PlaneFrame& frame = basis.frame();
  const auto slopes = [&](const Vec3& way) -> Vec2 {
    return (basis.at(frame.origin + size * way) - basis.at(frame.origin - size * way)).segment<2>(1) / (2 * size);
  };
  const Eigen::Matrix<double, 3, 2> of_functions =
      frame.e_1 * slopes(frame.e_1).transpose() + frame.e_2 * slopes(frame.e_2).transpose();
  return of_functions * field.radiosity.middleRows<2>(static_cast<Index>(element) * field.functions + 1);
}

}  // namespace

LinearField::LinearField(const Surroundings& around, const RadiositySolution& solution, Index channels)
    : centre_(static_cast<std::size_t>(around.elements()), Vec3::Zero()),
      constant_(ColumnMatrix::Zero(around.elements(), channels)),
      gradient_(ColumnMatrix::Zero(3 * around.elements(), channels)),
      linear_(solution.field && solution.field->order > 0) {
  const std::span<const scene::SurfacePatch> patches = solution.mesh.patches();
  constant_.topRows(std::ssize(patches)) = to_columns(solution.radiosity, static_cast<int>(channels));
  largest_ = constant_.size() > 0 ? constant_.cwiseAbs().maxCoeff() : 0;
  for (std::size_t i = 0; i < patches.size() && linear_; ++i) {
    const Cell cell = around.cell(patches[i].ring());
    centre_[i] = cell.centre;
    gradient_.middleRows<3>(static_cast<Index>(3 * i)) = gradient_of(*solution.field, i, cell.radius);
    for (const Vec3& x : cell.ring) largest_ = std::max(largest_, at(static_cast<Index>(i), x).cwiseAbs().maxCoeff());
  }
}

/// By the triangles of a fan: over one of area A the linear f has int f = A/3 sum f_k, int f² = A/12 (sum f_k² +
/// (sum f_k)²).  A part without area may be anything between what it is at its corners.
LinearField::OnPart LinearField::on(Index element, std::span<const Vec3> ring, Index channel) const {
  const double first = at(element, ring[0], channel);
  if (!linear_) return {first, first, first, 0};
  OnPart part{0, first, first, 0};
  double area = 0, squares = 0, before = at(element, ring[1], channel);
  part.lower = std::min(first, before);
  part.upper = std::max(first, before);
  for (std::size_t k = 2; k < ring.size(); ++k) {
    const double next = at(element, ring[k], channel), b = before - first, c = next - first,
                 A = (ring[k - 1] - ring[0]).cross(ring[k] - ring[0]).norm();
    area += A;
    part.mean += A / 3 * (b + c);
    squares += A / 12 * (b * b + c * c + (b + c) * (b + c));
    part.lower = std::min(part.lower, next);
    part.upper = std::max(part.upper, next);
    before = next;
  }
  if (!(area > 0)) return {0.5 * (part.lower + part.upper), part.lower, part.upper, 0.5 * (part.upper - part.lower)};
  part.mean /= area;
  part.deviation = std::sqrt(std::max(0.0, squares / area - part.mean * part.mean));
  part.mean += first;
  return part;
}

Eigen::Matrix<double, 2, Eigen::Dynamic> LinearField::gradient(Index element, const Cell& part) const {
  Eigen::Matrix<double, 2, 3> frame;
  frame << part.s.transpose(), part.t.transpose();
  return frame * gradient_.middleRows<3>(3 * element);
}

}  // namespace interflect::fem

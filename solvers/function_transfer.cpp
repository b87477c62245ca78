#include "solvers/function_transfer.h"

#include <algorithm>
#include <cmath>

namespace interflect::solvers {
namespace {

/// A_j times the root mean square of B_j, elements x columns.
ColumnMatrix sizes_of(const PointTransitions& points, std::span<const double> gram, const ColumnMatrix& coefficients) {
  const Index f = points.functions(), elements = coefficients.rows() / f;
  ColumnMatrix sizes(elements, coefficients.cols());
  const Eigen::Map<const Eigen::RowVectorXd> G(gram.data(), coefficients.rows());
  for (Index j = 0; j < elements; ++j)
    sizes.row(j) = (points.area(j) * (G.segment(j * f, f) * coefficients.middleRows(j * f, f).cwiseAbs2())).cwiseSqrt();
  return sizes;
}

ColumnMatrix per_area(const ColumnMatrix& power, std::span<const double> gram) {
  return Eigen::Map<const Eigen::VectorXd>(gram.data(), power.rows()).cwiseInverse().asDiagonal() * power;
}

}  // namespace

FunctionTransfer::FunctionTransfer(const System& system, const ColumnMatrix& power)
    : system_(system),
      points_(*system.walks->points()),
      coefficients_(per_area(power, system.K.gram())),
      draw_(sizes_of(points_, system.K.gram(), coefficients_)) {}

std::uint64_t FunctionTransfer::least_samples() const {
  const double rho = std::min(.99, system_.R.reflectance().maxCoeff());
  return static_cast<std::uint64_t>((4 + 2 * rho * rho / (1 - rho * rho)) * static_cast<double>(coefficients_.rows()));
}

void FunctionTransfer::add(const core::SampleSequence& sequence, std::uint64_t first, std::uint64_t count,
                           double weight, ColumnMatrix& reflected) const {
  if (draw_.nothing()) return;
  const Index f = points_.functions();
  const ColumnMatrix& rho = system_.R.reflectance();
  const double of_each = weight / static_cast<double>(count);
  double u[5];
  Eigen::RowVectorXd sent(f), received(f);
  const auto values_at = [&](const PointTransitions::Point& point, Eigen::RowVectorXd& values) {
    points_.functions_at(point, {values.data(), static_cast<std::size_t>(f)});
  };
  for (std::uint64_t k = first; k < first + count; ++k) {
    sequence.point(k, u);
    const auto [j, probability] = draw_(u[0]);
    const PointTransitions::Point y = points_.point_on(j, std::span(u).subspan(1, 2));
    const auto x = points_.from_point(y, std::span(u).subspan(3, 2));
    if (!x) continue;
    values_at(y, sent);
    values_at(*x, received);
    const Eigen::RowVectorXd B = points_.area(j) * of_each / probability * (sent * coefficients_.middleRows(j * f, f));
    for (Index a = 0; a < f; ++a)
      reflected.row(x->element * f + a) += received(a) * rho.row(x->element * f + a).cwiseProduct(B);
  }
}

}  // namespace interflect::solvers

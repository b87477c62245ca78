#include "solvers/power_draw.h"

#include <algorithm>
#include <cstddef>

namespace interflect::solvers {

PowerDraw::PowerDraw(const ColumnMatrix& power)
    : sizes_(power.cwiseAbs().colwise().sum()), cumulative_(static_cast<std::size_t>(power.rows()), 0) {
  Eigen::ArrayXd shares = Eigen::ArrayXd::Zero(power.rows());
  for (Index c = 0; c < power.cols(); ++c)
    if (sizes_(c) > 0) shares += power.col(c).array().abs() / sizes_(c);
  double sum = 0;
  for (std::size_t a = 0; a < cumulative_.size(); ++a) cumulative_[a] = sum += shares(static_cast<Index>(a));
  const std::size_t n = cumulative_.size();
  for (std::size_t k = 0, a = 0; k < n; ++k) {
    while (a + 1 < n && cumulative_[a] <= sum * (static_cast<double>(k) / static_cast<double>(n))) ++a;
    guide_.push_back(static_cast<std::uint32_t>(a));
  }
}

PowerDraw::Drawn PowerDraw::operator()(double u) const {
  const std::size_t n = cumulative_.size();
  const double all = cumulative_.back();
  std::size_t a = guide_[std::min(n - 1, static_cast<std::size_t>(u * static_cast<double>(n)))];
  while (a + 1 < n && cumulative_[a] <= u * all) ++a;
  while (a > 0 && !(cumulative_[a] > cumulative_[a - 1])) --a;  // by rounding, past all that sends anything
  return {static_cast<Index>(a), probability(static_cast<Index>(a))};
}

ColumnMatrix half_by_area(const ColumnMatrix& power, std::span<const double> areas) {
  const Eigen::Map<const Eigen::VectorXd> G(areas.data(), power.rows());
  ColumnMatrix drawn = power.cwiseAbs();
  for (Index c = 0; c < power.cols(); ++c) drawn.col(c) += drawn.col(c).sum() / G.sum() * G;
  return drawn;
}

ColumnMatrix power_of(std::span<const double> areas, ConstColumns radiosity) {
  const Eigen::Map<const Eigen::VectorXd> A(areas.data(), radiosity.rows());
  return A.asDiagonal() * radiosity;
}

}  // namespace interflect::solvers

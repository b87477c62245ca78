#include "solvers/power_draw.h"

#include <algorithm>

namespace interflect::solvers {

PowerDraw::PowerDraw(const ColumnMatrix& power) : cumulative_(static_cast<std::size_t>(power.rows()), 0) {
  Eigen::ArrayXd shares = Eigen::ArrayXd::Zero(power.rows());
  for (Index c = 0; c < power.cols(); ++c)
    if (const double all = power.col(c).cwiseAbs().sum(); all > 0) shares += power.col(c).array().abs() / all;
  double sum = 0;
  for (std::size_t a = 0; a < cumulative_.size(); ++a) cumulative_[a] = sum += shares(static_cast<Index>(a));
}

PowerDraw::Drawn PowerDraw::operator()(double u) const {
  const double all = cumulative_.back();
  auto at = std::upper_bound(cumulative_.begin(), cumulative_.end(), u * all);
  if (at == cumulative_.end()) at = std::lower_bound(cumulative_.begin(), cumulative_.end(), all);  // by rounding
  const double before = at == cumulative_.begin() ? 0 : *(at - 1);
  return {at - cumulative_.begin(), (*at - before) / all};
}

ColumnMatrix power_of(std::span<const double> areas, ConstColumns radiosity) {
  const Eigen::Map<const Eigen::VectorXd> A(areas.data(), radiosity.rows());
  return A.asDiagonal() * radiosity;
}

}  // namespace interflect::solvers

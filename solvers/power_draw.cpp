#include "solvers/power_draw.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/ordered_sum.h"

namespace interflect::solvers {

PowerDraw::PowerDraw(const ColumnMatrix& power)
    : sizes_(column_sizes(power)), cumulative_(static_cast<std::size_t>(power.rows())), guide_(cumulative_.size() + 2) {
  const Eigen::RowVectorXd weight = (sizes_.array() > 0).select(sizes_.cwiseInverse(), 0);
  double sum = 0;
  const double* entry = power.data();
  for (double& cumulative : cumulative_) {
    double share = 0;
    for (Index c = 0; c < weight.size(); ++c) share += weight(c) * std::abs(*entry++);
    cumulative = sum += share;
  }
  if (sum > 0 && std::isfinite(sum)) make_guide();
}

/// guide[k] = how many unknowns end before part k begins, whatever rounds: counted where they end, and added up.  A
/// pass without branches, since there may be no more draws than unknowns.
void PowerDraw::make_guide() {
  constexpr double whatever_rounds = 1 + 1e-12;  // what ends at the last part's end still counts at last + 1
  const double parts = static_cast<double>(cumulative_.size()) / cumulative_.back() * whatever_rounds;
  for (const double end : cumulative_) ++guide_[1 + static_cast<std::size_t>(end * parts)];
  std::uint32_t before = 0;
  for (std::uint32_t& of_part : guide_) of_part = before += of_part;
}

PowerDraw::Drawn PowerDraw::operator()(double u) const {
  const std::size_t n = cumulative_.size();
  const double all = cumulative_.back();
  std::size_t a = guide_[static_cast<std::size_t>(u * static_cast<double>(n))];
  while (a + 1 < n && cumulative_[a] <= u * all) ++a;
  while (a > 0 && !(cumulative_[a] > cumulative_[a - 1])) --a;  // by rounding, past all that sends anything
  return {static_cast<Index>(a), probability(static_cast<Index>(a))};
}

Eigen::RowVectorXd column_sizes(const ColumnMatrix& power) {
  // Several rows at a time, as one long row: sums that do not wait for each other.
  constexpr Index together = 8;
  const Index columns = power.cols(), blocks = power.rows() / together;
  Eigen::RowVectorXd wide = Eigen::RowVectorXd::Zero(together * columns);
  for (Index b = 0; b < blocks; ++b)
    wide += Eigen::Map<const Eigen::RowVectorXd>(power.data() + b * wide.size(), wide.size()).cwiseAbs();
  Eigen::RowVectorXd sizes = Eigen::RowVectorXd::Zero(columns);
  for (Index k = 0; k < together; ++k) sizes += wide.segment(k * columns, columns);
  for (Index a = blocks * together; a < power.rows(); ++a) sizes += power.row(a).cwiseAbs();
  return sizes;
}

ColumnMatrix half_by_area(const ColumnMatrix& power, std::span<const double> areas) {
  const Eigen::Map<const Eigen::VectorXd> G(areas.data(), power.rows());
  ColumnMatrix drawn = power.cwiseAbs();
  const double area = core::ordered_sum(G);
  for (Index c = 0; c < power.cols(); ++c) drawn.col(c) += core::ordered_sum(drawn.col(c)) / area * G;
  return drawn;
}

ColumnMatrix power_of(std::span<const double> areas, ConstColumns radiosity) {
  const Eigen::Map<const Eigen::VectorXd> A(areas.data(), radiosity.rows());
  return A.asDiagonal() * radiosity;
}

}  // namespace interflect::solvers

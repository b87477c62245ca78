#include "fem/row_tally.h"

#include <cmath>

namespace interflect::fem {

namespace {

constexpr double unit = 0x1p-52;

}  // namespace

void RowTally::add(Index a, double error) {
  if (error == 0) return;
  const auto at = static_cast<std::size_t>(a);
  const double units = std::ceil(error / areas_[at] / unit);
  constexpr double most = 0x1p60;  // 256: no sum of form factors is wrong by as much
  sum_[at].fetch_add(static_cast<std::uint64_t>(units < most ? units : most), std::memory_order_relaxed);
}

double RowTally::of(Index a) const {
  return unit * static_cast<double>(sum_[static_cast<std::size_t>(a)].load(std::memory_order_relaxed));
}

std::vector<double> RowTally::all() const {
  std::vector<double> errors;
  for (Index a = 0; a < static_cast<Index>(sum_.size()); ++a) errors.push_back(of(a));
  return errors;
}

}  // namespace interflect::fem

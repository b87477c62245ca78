#include "solvers/line_transfer.h"

namespace interflect::solvers {

LineTransfer::LineTransfer(const System& system, const ColumnMatrix& power)
    : system_(system), power_(power), lines_(*system.walks->lines()) {}

void LineTransfer::add(const core::SampleSequence& sequence, std::uint64_t first, std::uint64_t count, double weight,
                       ColumnMatrix& reflected) const {
  const std::span<const double> G = system_.K.gram();
  const ColumnMatrix& rho = system_.R.reflectance();
  const double by = weight * lines_.measure() / (2 * static_cast<double>(count));
  std::vector<double> u(static_cast<std::size_t>(lines_.dimensions()));
  std::vector<LineExchanges::Exchange> exchanges;
  for (std::uint64_t k = first; k < first + count; ++k) {
    sequence.point(k, u);
    lines_.along(u, exchanges);
    for (const auto& [i, j] : exchanges) {
      reflected.row(i) += by / G[static_cast<std::size_t>(j)] * rho.row(i).cwiseProduct(power_.row(j));
      reflected.row(j) += by / G[static_cast<std::size_t>(i)] * rho.row(j).cwiseProduct(power_.row(i));
    }
  }
}

}  // namespace interflect::solvers

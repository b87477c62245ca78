#include "solvers/power_transfer.h"

#include <vector>

namespace interflect::solvers {

PowerTransfer::PowerTransfer(const System& system, const ColumnMatrix& power)
    : system_(system), power_(power), draw_(power) {}

void PowerTransfer::add(const core::SampleSequence& sequence, std::uint64_t first, std::uint64_t count, double weight,
                        ColumnMatrix& reflected) const {
  if (draw_.nothing()) return;
  const auto draw = static_cast<std::size_t>(system_.walks->dimensions());
  std::vector<double> u(1 + draw);
  for (std::uint64_t k = first; k < first + count; ++k) {
    sequence.point(k, u);
    const auto [j, probability] = draw_(u[0]);
    const std::optional<Index> i = system_.walks->from_element(j, std::span(u).subspan(1));
    if (!i) continue;
    const double by = weight / (probability * static_cast<double>(count));
    reflected.row(*i) += by * system_.R.reflectance().row(*i).cwiseProduct(power_.row(j));
  }
}

}  // namespace interflect::solvers

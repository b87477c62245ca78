#include "solvers/power_transfer.h"

#include <vector>

namespace interflect::solvers {

void PowerTransfer::add(const core::SampleSequence& sequence, std::uint64_t first, std::uint64_t count, double weight,
                        ColumnMatrix& reflected) const {
  if (draw_.nothing()) return;
  const auto draw = static_cast<std::size_t>(system_.walks->dimensions());
  const std::span<const double> G = system_.K.gram();
  const ColumnMatrix& rho = system_.R.reflectance();
  const double of_each = weight / static_cast<double>(count);
  std::vector<double> u(1 + draw);
  for (std::uint64_t k = first; k < first + count; ++k) {
    sequence.point(k, u);
    const auto [j, probability] = draw_(u[0]);
    const std::optional<Index> i = system_.walks->from_element(j, std::span(u).subspan(1));
    if (!i) continue;
    if (lines_ == Lines::one_way) {
      reflected.row(*i) += of_each / probability * rho.row(*i).cwiseProduct(power_.row(j));
      continue;
    }
    const double G_i = G[static_cast<std::size_t>(*i)], G_j = G[static_cast<std::size_t>(j)];
    const double by = of_each / (probability / G_j + draw_.probability(*i) / G_i);
    reflected.row(*i) += by / G_j * rho.row(*i).cwiseProduct(power_.row(j));
    reflected.row(j) += by / G_i * rho.row(j).cwiseProduct(power_.row(*i));
  }
}

}  // namespace interflect::solvers

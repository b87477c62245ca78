#include "solvers/power_transfer.h"

#include <algorithm>
#include <array>
#include <vector>

namespace interflect::solvers {
namespace {

constexpr std::size_t at_once = 256;  ///< samples: what they take stays near the processor

}  // namespace

void PowerTransfer::add(const core::SampleSequence& sequence, std::uint64_t first, std::uint64_t count, double weight,
                        ColumnMatrix& reflected) const {
  if (draw_.nothing()) return;
  const auto draw = static_cast<std::size_t>(system_.walks->dimensions());
  const double of_each = weight / static_cast<double>(count);
  std::vector<double> numbers(at_once * (1 + draw)), ways(at_once * draw);
  std::array<double, at_once> probability;
  std::array<Index, at_once> from, arrived;
  for (std::uint64_t k = first; k < first + count; k += at_once) {
    const auto n = static_cast<std::size_t>(std::min<std::uint64_t>(at_once, first + count - k));
    sequence.points(k, 1 + draw, std::span(numbers).first(n * (1 + draw)));
    for (std::size_t s = 0; s < n; ++s) {
      const double* u = &numbers[s * (1 + draw)];
      const PowerDraw::Drawn drawn = draw_(u[0]);
      from[s] = drawn.unknown, probability[s] = drawn.probability;
      std::copy(u + 1, u + 1 + draw, &ways[s * draw]);
    }
    system_.walks->from_elements(std::span(from).first(n), ways, arrived);
    for (std::size_t s = 0; s < n; ++s)
      if (arrived[s] != TransitionSampler::nowhere) exchange(from[s], arrived[s], probability[s], of_each, reflected);
  }
}

void PowerTransfer::exchange(Index j, Index i, double probability, double of_each, ColumnMatrix& reflected) const {
  if (lines_ == Lines::one_way) {
    bring(j, i, of_each / probability, reflected);
    return;
  }
  const std::span<const double> G = system_.K.gram();
  const double G_i = G[static_cast<std::size_t>(i)], G_j = G[static_cast<std::size_t>(j)];
  const double by = of_each / (probability / G_j + draw_.probability(i) / G_i);
  bring(j, i, by / G_j, reflected);
  bring(i, j, by / G_i, reflected);
}

void PowerTransfer::bring(Index j, Index i, double share, ColumnMatrix& reflected) const {
  const Index columns = power_.cols();
  const double *rho = &system_.R.reflectance()(i, 0), *power = &power_(j, 0);
  double* at = &reflected(i, 0);
  for (Index c = 0; c < columns; ++c) at[c] += share * (rho[c] * power[c]);
}

}  // namespace interflect::solvers

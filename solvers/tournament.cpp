#include "solvers/tournament.h"

#include <bit>
#include <cmath>

namespace interflect::solvers {

Tournament::Tournament(Index players)
    : leaves_(std::max<Index>(2, static_cast<Index>(std::bit_ceil(static_cast<std::size_t>(players))))),
      values_(static_cast<std::size_t>(leaves_), -1.0),
      winners_(static_cast<std::size_t>(leaves_)) {
  std::fill_n(values_.begin(), players, 0.0);
  for (Index node = leaves_ - 1; node > 0; --node) {
    const Index level =
        std::bit_width(static_cast<std::size_t>(leaves_)) - std::bit_width(static_cast<std::size_t>(node));
    winners_[static_cast<std::size_t>(node)] = (node << level) - leaves_;  // of equal ones the first
  }
}

Index Tournament::better(Index a, Index b) const {
  const double of_a = values_[static_cast<std::size_t>(a)], of_b = values_[static_cast<std::size_t>(b)];
  if (std::isnan(of_a)) return a;
  return of_a >= of_b ? a : b;
}

void Tournament::set(Index player, double value) {
  values_[static_cast<std::size_t>(player)] = value;
  Index node = (leaves_ + player) / 2;
  const Index left = player & ~Index{1};
  winners_[static_cast<std::size_t>(node)] = better(left, left + 1);
  for (node /= 2; node > 0; node /= 2)
    winners_[static_cast<std::size_t>(node)] =
        better(winners_[static_cast<std::size_t>(2 * node)], winners_[static_cast<std::size_t>(2 * node + 1)]);
}

}  // namespace interflect::solvers

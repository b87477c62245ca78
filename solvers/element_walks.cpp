#include "solvers/element_walks.h"

#include <algorithm>

#include "solvers/potential.h"
#include "solvers/sampled_rounds.h"

namespace interflect::solvers {

std::span<const double> WalkNumbers::next(std::size_t count) {
  if (used_ + count > numbers_.size()) {
    numbers_.resize(std::max(numbers_.size(), count));
    used_ = numbers_.size() - count;
    for (std::size_t k = used_; k < numbers_.size(); ++k) numbers_[k] = others_.next();
  }
  used_ += count;
  return std::span(numbers_).subspan(used_ - count, count);
}

WalkSequences::WalkSequences(const SolverSettings& settings, std::uint64_t seed, std::size_t first)
    : seed_(seed), first_(first), sequences_(sequences_for(settings, seed)) {}

WalkNumbers WalkSequences::operator()(int replication, std::uint64_t k, Index unknown) const {
  const std::uint64_t index = static_cast<std::uint64_t>(unknown) << 20 | k;
  const auto r = static_cast<std::size_t>(replication);
  return {*sequences_[r], index, {seed_, static_cast<std::uint32_t>(1 + replication), index}, first_};
}

ElementWalks::ElementWalks(const System& system, Score score)
    : system_(system),
      score_(score),
      births_(power_of(system.K.gram(), system.e)),
      draw_(static_cast<std::size_t>(system.walks->dimensions())) {}

void ElementWalks::prefer_sources(const ColumnMatrix& worth) {
  const ColumnMatrix power = power_of(system_.K.gram(), system_.e);
  births_ = PowerDraw(power.cwiseProduct(defensive(worth, power)));
}

void ElementWalks::prefer_ways(const ColumnMatrix& worth) {
  prefer_sources(worth);
  const ColumnMatrix power = power_of(system_.K.gram(), system_.e);
  worth_ = defensive(worth, power);
  for (Index c = 0; c < worth_.cols(); ++c)
    if (births_.sizes()(c) > 0)
      worth_.col(c) /= births_.sizes()(c) * static_cast<double>((births_.sizes().array() > 0).count());
}

double ElementWalks::going_on(Index at, const Row& carried, const Row& reflected) const {
  const double all = carried.cwiseAbs().sum();
  if (!(all > 0)) return 0;
  const double by_rho = reflected.cwiseAbs().sum() / all;
  if (worth_.size() == 0) return by_rho;
  return std::clamp(reflected.cwiseAbs().dot(worth_.row(at)), .1 * by_rho, 1.0);
}

template <class Next>
std::uint64_t ElementWalks::shoot_by(const Next& next, WalkNumbers& numbers, ColumnMatrix& sum) const {
  const auto [source, probability] = births_(numbers.next(1)[0]);
  return walk(
      source, system_.e.row(source) * (area(source) / probability), numbers, next,
      [&](Index i, const Row& carried, double score) { sum.row(i) += score / area(i) * rho(i).cwiseProduct(carried); });
}

std::uint64_t ElementWalks::shoot(WalkNumbers numbers, ColumnMatrix& sum) const {
  return shoot_by(between_elements(numbers), numbers, sum);
}

std::uint64_t ElementWalks::shoot_on(WalkNumbers numbers, ColumnMatrix& sum) const {
  const PointTransitions& points = *system_.walks->points();
  std::optional<PointTransitions::Point> at;
  const auto next = [&](Index from) {
    if (!at) at = points.point_on(from, numbers.next(2));
    at = points.from_point(*at, numbers.next(2));
    return at ? std::optional<Index>(at->element) : std::nullopt;
  };
  return shoot_by(next, numbers, sum);
}

}  // namespace interflect::solvers

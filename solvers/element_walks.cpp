#include "solvers/element_walks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "core/random.h"
#include "solvers/potential.h"

namespace interflect::solvers {

ElementWalks::Wave::Wave(std::span<const WalkStart> starts, const WalkNumbers& numbers, Index columns)
    : carried(static_cast<Index>(starts.size()), columns),
      numbers_(numbers),
      first_(starts.size() * numbers.first),
      used_(numbers.used) {
  for (const WalkStart& each : starts) {
    start.push_back(each.unknown);
    walk_.push_back(each.walk);
  }
  at = start;
  numbers_.sequence.points_of(walk_, numbers_.first, first_);
}

void ElementWalks::Wave::shrink(std::size_t size) {
  if (size < walk_.size()) used_ = numbers_.first;
  const auto cut = [size](auto& of_each) {
    of_each.erase(of_each.begin() + static_cast<std::ptrdiff_t>(size), of_each.end());
  };
  cut(start), cut(at), cut(walk_);
  if (!point.empty()) cut(point);
}

void ElementWalks::Wave::draw(std::size_t count, std::vector<double>& u) {
  u.resize(size() * count);
  if (used_ + count > numbers_.first) {
    core::random_numbers(numbers_.seed, numbers_.stream, walk_, drawn_, count, u);
    drawn_ += count;
    return;
  }
  for (std::size_t k = 0; k < size(); ++k) std::copy_n(&first_[k * numbers_.first + used_], count, &u[k * count]);
  used_ += count;
}

ElementWalks::ElementWalks(const System& system, Score score)
    : system_(system),
      score_(score),
      births_(power_of(system.K.gram(), system.e)),
      draw_(static_cast<std::size_t>(system.walks->dimensions())),
      places_(system.e.rows(), system.e.cols() + 1) {
  places_.leftCols(system.e.cols()) = system.R.reflectance();
  for (Index a = 0; a < places_.rows(); ++a) places_(a, system.e.cols()) = 1 / area(a);
}

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

double ElementWalks::going_on(Index at, double by_rho, const double* by_column) const {
  double worth = 0;
  for (Index c = 0; c < worth_.cols(); ++c) worth += std::abs(by_column[c]) * worth_(at, c);
  return by_rho > 0 ? std::clamp(worth, .1 * by_rho, 1.0) : 0;
}

template <class Step, class Hit>
std::uint64_t ElementWalks::walk(Wave wave, const Step& step, const Hit& hit) const {
  const Index columns = wave.carried.cols();
  switch (columns) {  // loops over so many are unrolled where that is known beforehand
    case 1:
      return walk(std::move(wave), step, hit, std::integral_constant<Index, 1>{});
    case 3:
      return walk(std::move(wave), step, hit, std::integral_constant<Index, 3>{});
    default:
      return walk(std::move(wave), step, hit, columns);
  }
}

template <class Step, class Hit, class Count>
std::uint64_t ElementWalks::walk(Wave wave, const Step& step, const Hit& hit, Count columns) const {
  constexpr std::size_t ahead = 16;  // places that are fetched while others are looked at
  std::uint64_t draws = 0;
  std::vector<Index> arrived(wave.size());
  std::vector<double> reflected(static_cast<std::size_t>(columns));
  while (wave.size() > 0) {
    step(wave, std::span(arrived).first(wave.size()));
    draws += wave.size();
    std::size_t kept = 0;
    for (std::size_t k = 0; k < wave.size(); ++k) {
      if (k + ahead < wave.size()) __builtin_prefetch(place(std::max<Index>(0, arrived[k + ahead])));
      const Index at = arrived[k];
      if (at == TransitionSampler::nowhere) continue;
      const double *carried = wave.carried.data() + static_cast<Index>(k) * columns, *rho = place(at);
      double all = 0, left = 0;
      for (Index c = 0; c < columns; ++c) {
        const double value = rho[c] * carried[c];
        reflected[static_cast<std::size_t>(c)] = value;
        all += std::abs(carried[c]), left += std::abs(value);
      }
      const double by_rho = all > 0 ? left / all : 0;
      const double on = worth_.size() == 0 ? by_rho : going_on(at, by_rho, reflected.data());
      const bool survives = wave.on[k] < on;
      if (score_ == Score::collision)
        hit(wave.start[k], at, carried, reflected.data(), 1, columns);
      else if (survives == (score_ == Score::survival))
        hit(wave.start[k], at, carried, reflected.data(), 1 / (survives ? on : 1 - on), columns);
      // Kept first and counted then: which of them goes on cannot be foretold, and a branch would be.
      wave.keep(k, kept, at);
      double* next = wave.carried.data() + static_cast<Index>(kept) * columns;
      const double by = 1 / std::max(on, std::numeric_limits<double>::min());
      for (Index c = 0; c < columns; ++c) next[c] = by * reflected[static_cast<std::size_t>(c)];
      kept += survives;
    }
    wave.shrink(kept);
  }
  return draws;
}

void ElementWalks::step_between_elements(Wave& wave, std::span<Index> arrived) const {
  std::vector<double>& ways = wave.ways;
  wave.draw(draw_ + 1, ways);
  wave.on.resize(wave.size());
  for (std::size_t k = 0; k < wave.size(); ++k) {
    wave.on[k] = ways[k * (draw_ + 1) + draw_];
    std::copy_n(&ways[k * (draw_ + 1)], draw_, &ways[k * draw_]);
  }
  system_.walks->from_elements(wave.at, std::span(ways).first(wave.size() * draw_), arrived);
}

void ElementWalks::step_between_points(Wave& wave, std::span<Index> arrived) const {
  const PointTransitions& points = *system_.walks->points();
  if (wave.point.empty()) {
    wave.draw(2, wave.ways);
    for (std::size_t k = 0; k < wave.size(); ++k)
      wave.point.push_back(points.point_on(wave.at[k], std::span(wave.ways).subspan(2 * k, 2)));
  }
  wave.draw(2, wave.ways);
  wave.draw(1, wave.on);
  for (std::size_t k = 0; k < wave.size(); ++k) {
    const auto next = points.from_point(wave.point[k], std::span(wave.ways).subspan(2 * k, 2));
    arrived[k] = next ? next->element : TransitionSampler::nowhere;
    if (next) wave.point[k] = *next;
  }
}

ElementWalks::Wave ElementWalks::births(std::span<const WalkStart> starts, const WalkNumbers& numbers) const {
  Wave wave(starts, numbers, system_.e.cols());
  wave.draw(1, wave.ways);
  for (std::size_t k = 0; k < wave.size(); ++k) {
    const auto [source, probability] = births_(wave.ways[k]);
    wave.at[k] = source;
    wave.carried.row(static_cast<Index>(k)) = system_.e.row(source) / (place(source)[system_.e.cols()] * probability);
  }
  return wave;
}

template <class Step>
std::uint64_t ElementWalks::shoot_by(const Step& step, Wave wave, ColumnMatrix& sum) const {
  const auto hit = [&](Index, Index i, const double*, const double* reflected, double score, auto columns) {
    double* to = sum.data() + i * columns;
    const double share = score * place(i)[columns];
    for (Index c = 0; c < columns; ++c) to[c] += share * reflected[c];
  };
  return walk(std::move(wave), step, hit);
}

std::uint64_t ElementWalks::shoot(std::span<const WalkStart> starts, const WalkNumbers& numbers,
                                  ColumnMatrix& sum) const {
  return shoot_by([this](Wave& wave, std::span<Index> arrived) { step_between_elements(wave, arrived); },
                  births(starts, numbers), sum);
}

std::uint64_t ElementWalks::shoot_on(std::span<const WalkStart> starts, const WalkNumbers& numbers,
                                     ColumnMatrix& sum) const {
  return shoot_by([this](Wave& wave, std::span<Index> arrived) { step_between_points(wave, arrived); },
                  births(starts, numbers), sum);
}

/// What is carried has the reflectance at the start.
template <class Hit>
std::uint64_t ElementWalks::gather_by(std::span<const WalkStart> starts, const WalkNumbers& numbers,
                                      const Hit& hit) const {
  Wave wave(starts, numbers, system_.e.cols());
  for (std::size_t k = 0; k < wave.size(); ++k) wave.carried.row(static_cast<Index>(k)) = rho(wave.at[k]);
  return walk(
      std::move(wave), [this](Wave& under_way, std::span<Index> arrived) { step_between_elements(under_way, arrived); },
      hit);
}

std::uint64_t ElementWalks::gather(std::span<const WalkStart> starts, const WalkNumbers& numbers,
                                   const Scored& scored) const {
  Row of_one(system_.e.cols());
  return gather_by(starts, numbers,
                   [&](Index start, Index at, const double* carried, const double*, double score, auto) {
                     for (Index c = 0; c < of_one.size(); ++c) of_one(c) = score * carried[c] * system_.e(at, c);
                     scored(start, of_one, at);
                   });
}

std::uint64_t ElementWalks::gather(std::span<const WalkStart> starts, const WalkNumbers& numbers,
                                   ColumnMatrix& sum) const {
  const auto hit = [&](Index start, Index at, const double* carried, const double*, double score, auto columns) {
    const double* e = system_.e.data() + at * system_.e.outerStride();
    double* to = sum.data() + start * columns;
    for (Index c = 0; c < columns; ++c) to[c] += score * carried[c] * e[c];
  };
  return gather_by(starts, numbers, hit);
}

}  // namespace interflect::solvers

#include "solvers/element_walks.h"

#include <algorithm>

#include "core/error.h"
#include "solvers/potential.h"

namespace interflect::solvers {

ElementWalks::Wave::Wave(std::span<const WalkStart> starts, Index columns)
    : carried(static_cast<Index>(starts.size()), columns) {
  for (const WalkStart& each : starts) {
    start.push_back(each.unknown);
    numbers.push_back(each.numbers);
  }
  at = start;
}

void ElementWalks::Wave::keep(std::size_t from, std::size_t to) {
  start[to] = start[from], at[to] = at[from], numbers[to] = numbers[from];
  if (!point.empty()) point[to] = point[from];
}

void ElementWalks::Wave::shrink(std::size_t size) {
  const auto cut = [size](auto& of_each) {
    of_each.erase(of_each.begin() + static_cast<std::ptrdiff_t>(size), of_each.end());
  };
  cut(start), cut(at), cut(numbers);
  if (!point.empty()) cut(point);
}

ElementWalks::ElementWalks(const System& system, Score score)
    : system_(system),
      score_(score),
      births_(power_of(system.K.gram(), system.e)),
      draw_(static_cast<std::size_t>(system.walks->dimensions())) {
  if (1 + first_numbers() > WalkNumbers::most)
    throw core::PreconditionError("random walks: a draw takes more numbers than are kept");
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

double ElementWalks::going_on(Index at, const ConstRow& carried, const ConstRow& reflected) const {
  const double all = carried.cwiseAbs().sum();
  if (!(all > 0)) return 0;
  const double by_rho = reflected.cwiseAbs().sum() / all;
  if (worth_.size() == 0) return by_rho;
  return std::clamp(reflected.cwiseAbs().dot(worth_.row(at)), .1 * by_rho, 1.0);
}

template <class Step, class Hit>
std::uint64_t ElementWalks::walk(Wave wave, const Step& step, const Hit& hit) const {
  std::uint64_t draws = 0;
  std::vector<Index> arrived(wave.size());
  Row reflected(wave.carried.cols());
  while (wave.size() > 0) {
    step(wave, std::span(arrived).first(wave.size()));
    draws += wave.size();
    std::size_t kept = 0;
    for (std::size_t k = 0; k < wave.size(); ++k) {
      const Index at = arrived[k];
      if (at == TransitionSampler::nowhere) continue;
      const auto carried = wave.carried.row(static_cast<Index>(k));
      reflected = rho(at).cwiseProduct(carried);
      const double on = going_on(at, carried, reflected);
      const bool survives = wave.numbers[k].next(1)[0] < on;
      if (score_ == Score::collision)
        hit(wave.start[k], at, carried, 1);
      else if (survives == (score_ == Score::survival))
        hit(wave.start[k], at, carried, 1 / (survives ? on : 1 - on));
      if (!survives) continue;
      wave.at[k] = at;
      wave.keep(k, kept);
      wave.carried.row(static_cast<Index>(kept++)) = reflected / on;
    }
    wave.shrink(kept);
  }
  return draws;
}

void ElementWalks::step_between_elements(Wave& wave, std::span<Index> arrived) const {
  std::vector<double> u(wave.size() * draw_);
  for (std::size_t k = 0; k < wave.size(); ++k) std::ranges::copy(wave.numbers[k].next(draw_), &u[k * draw_]);
  system_.walks->from_elements(wave.at, u, arrived);
}

void ElementWalks::step_between_points(Wave& wave, std::span<Index> arrived) const {
  const PointTransitions& points = *system_.walks->points();
  if (wave.point.empty())
    for (std::size_t k = 0; k < wave.size(); ++k)
      wave.point.push_back(points.point_on(wave.at[k], wave.numbers[k].next(2)));
  for (std::size_t k = 0; k < wave.size(); ++k) {
    const auto next = points.from_point(wave.point[k], wave.numbers[k].next(2));
    arrived[k] = next ? next->element : TransitionSampler::nowhere;
    if (next) wave.point[k] = *next;
  }
}

ElementWalks::Wave ElementWalks::births(std::span<const WalkStart> starts) const {
  Wave wave(starts, system_.e.cols());
  for (std::size_t k = 0; k < wave.size(); ++k) {
    const auto [source, probability] = births_(wave.numbers[k].next(1)[0]);
    wave.at[k] = source;
    wave.carried.row(static_cast<Index>(k)) = system_.e.row(source) * (area(source) / probability);
  }
  return wave;
}

template <class Step>
std::uint64_t ElementWalks::shoot_by(const Step& step, Wave wave, ColumnMatrix& sum) const {
  return walk(std::move(wave), step, [&](Index, Index i, const auto& carried, double score) {
    sum.row(i) += score / area(i) * rho(i).cwiseProduct(carried);
  });
}

std::uint64_t ElementWalks::shoot(std::span<const WalkStart> starts, ColumnMatrix& sum) const {
  return shoot_by([this](Wave& wave, std::span<Index> arrived) { step_between_elements(wave, arrived); },
                  births(starts), sum);
}

std::uint64_t ElementWalks::shoot_on(std::span<const WalkStart> starts, ColumnMatrix& sum) const {
  return shoot_by([this](Wave& wave, std::span<Index> arrived) { step_between_points(wave, arrived); }, births(starts),
                  sum);
}

std::uint64_t ElementWalks::gather(std::span<const WalkStart> starts, const Scored& scored) const {
  Wave wave(starts, system_.e.cols());
  for (std::size_t k = 0; k < wave.size(); ++k) wave.carried.row(static_cast<Index>(k)) = rho(wave.at[k]);
  Row of_one(system_.e.cols());
  return walk(
      std::move(wave), [this](Wave& under_way, std::span<Index> arrived) { step_between_elements(under_way, arrived); },
      [&](Index start, Index at, const auto& carried, double score) {
        of_one = score * carried.cwiseProduct(system_.e.row(at));
        scored(start, of_one, at);
      });
}

std::uint64_t ElementWalks::gather(std::span<const WalkStart> starts, ColumnMatrix& sum) const {
  return gather(starts, [&](Index start, const ConstRow& score, Index) { sum.row(start) += score; });
}

}  // namespace interflect::solvers

#include "solvers/potential.h"

#include <algorithm>

#include "core/random.h"
#include "solvers/power_transfer.h"

namespace interflect::solvers {
namespace {

constexpr std::uint64_t parts = 8;

std::unique_ptr<PowerTransfer> evenly(const System& system, const ColumnMatrix& power) {
  return std::make_unique<PowerTransfer>(system, power, PowerTransfer::Lines::both_ways,
                                         half_by_area(power, system.K.gram()));
}

}  // namespace

Potential::Potential(const System& system, const SolverSettings& settings, const Run& run, std::uint64_t rays,
                     std::function<void()> between)
    : system_(system), run_(run), rays_(std::max<std::uint64_t>(1, rays / parts)), between_(std::move(between)) {
  const auto first = core::make_sequence(settings.sequence, core::derived_seed(run.seed, "potential") + rays);
  for (std::uint64_t part = 0; part < parts; ++part) sequences_.push_back(first->replicate(part));
  const Eigen::Map<const Eigen::VectorXd> G(system.K.gram().data(), system.e.rows());
  const Eigen::Map<const Eigen::VectorXd> t(system.target.data(), system.e.rows());
  source_ = t.cwiseQuotient(G).asDiagonal() * system.R.reflectance();
  received_ = solved(source_);
}

template <class Work>
ColumnMatrix Potential::in_parts(const Work& work) {
  std::vector<ColumnMatrix> found(parts);
  run_.threads.for_blocks(static_cast<Index>(parts), 1, [&](Index part, Index) {
    found[static_cast<std::size_t>(part)] = work(*sequences_[static_cast<std::size_t>(part)]->replicate(used_));
  });
  ++used_;
  ColumnMatrix sum = found.front();
  for (std::size_t part = 1; part < parts; ++part) sum += found[part];
  return sum / static_cast<double>(parts);
}

/// x = source + R F x.
ColumnMatrix Potential::solved(const ColumnMatrix& source) {
  const Eigen::Map<const Eigen::VectorXd> G(system_.K.gram().data(), source.rows());
  const ColumnMatrix power = G.asDiagonal() * source;
  return source + G.cwiseInverse().asDiagonal() * in_parts([&](const core::SampleSequence& sequence) {
                    Bounces bounces([&](const ColumnMatrix& sent) { return evenly(system_, sent); }, sequence);
                    ColumnMatrix reflected = bounces.incremental(power, rays_, between_);
                    draws_ += bounces.draws();
                    return reflected;
                  });
}

/// F x, F G = (F G)^T.
ColumnMatrix Potential::gathered(const ColumnMatrix& of) {
  const Eigen::Map<const Eigen::VectorXd> G(system_.K.gram().data(), of.rows());
  const Reflection all(ColumnMatrix::Ones(of.rows(), of.cols()));
  const System white{system_.K, all, system_.e, system_.walks};
  const ColumnMatrix power = G.asDiagonal() * of;
  const auto transfer = evenly(white, power);
  return G.cwiseInverse().asDiagonal() * in_parts([&](const core::SampleSequence& sequence) {
           between_();
           ColumnMatrix arrived = ColumnMatrix::Zero(of.rows(), of.cols());
           transfer->add(sequence, 0, rays_, 1, arrived);
           draws_ += rays_;
           return arrived;
         });
}

ColumnMatrix Potential::of_a_bounce() { return gathered(received_.cwiseAbs2()).cwiseSqrt(); }

ColumnMatrix Potential::of_a_walk() {
  const ColumnMatrix moments = solved(source_.cwiseProduct(2 * received_ - source_));
  return gathered(moments).cwiseMax(0).cwiseSqrt();
}

std::uint64_t potential_rays(const System& system, std::uint64_t rays_of_round) {
  const auto n = static_cast<std::uint64_t>(system.e.rows());
  return std::clamp<std::uint64_t>(rays_of_round / 16, 16 * n, 1024 * n);
}

ColumnMatrix defensive(const ColumnMatrix& worth, const ColumnMatrix& power) {
  constexpr double share = .1;
  ColumnMatrix mixed = (1 - share) * worth;
  for (Index c = 0; c < worth.cols(); ++c) {
    const double all = power.col(c).cwiseAbs().sum(), mean = power.col(c).cwiseAbs().dot(worth.col(c)) / all;
    mixed.col(c).array() += mean > 0 ? share * mean : 1;
  }
  return mixed;
}

}  // namespace interflect::solvers

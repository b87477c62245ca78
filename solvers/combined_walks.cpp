#include "solvers/combined_walks.h"

#include <algorithm>
#include <cmath>

#include "core/ordered_sum.h"
#include "core/random.h"
#include "solvers/potential.h"
#include "solvers/power_transfer.h"
#include "solvers/sampled_rounds.h"
#include "solvers/system_check.h"

namespace interflect::solvers {
namespace {

/// n_i at a lambda.
Eigen::ArrayXd gathered_at(double lambda, const Eigen::ArrayXd& shooting, const Eigen::ArrayXd& gathering,
                           const Eigen::ArrayXd& G) {
  const Eigen::ArrayXd n = gathering * ((G / (lambda * gathering)).sqrt() - 1 / shooting);
  return (shooting > 0 && gathering > 0).select(n.max(0), 0);
}

/// What one more walk that shoots would gain, less lambda.
double surplus(double lambda, const Eigen::ArrayXd& shooting, const Eigen::ArrayXd& gathering,
               const Eigen::ArrayXd& G) {
  const Eigen::ArrayXd n = gathered_at(lambda, shooting, gathering, G);
  const Eigen::ArrayXd known = 1 / shooting + (n > 0).select(n / gathering, 0);
  return (shooting > 0).select(G / (shooting * known.square()), 0).sum() - lambda;
}

/// Estimates of what variances are made of, by rays.
class Pilot {
 public:
  Pilot(const System& system, const SolverSettings& settings, const Run& run)
      : system_(system), sequence_(core::make_sequence(settings.sequence, core::derived_seed(run.seed, "pilot"))) {
    gather_seed_ = core::derived_seed(run.seed, "gathered once");
    reflected_ = reflected(system.e);
    received_ = reflected(system.e.cwiseProduct(system.e + 2 * reflected_));
    count_returns(core::derived_seed(run.seed, "returns"));
  }

  std::uint64_t draws() const { return draws_; }

  /// @param most  that gather, for one that shoots
  WalkPlan plan(double most) const {
    const Eigen::Map<const Eigen::VectorXd> G(system_.K.gram().data(), system_.e.rows());
    const ColumnMatrix& rho = system_.R.reflectance();
    const Eigen::RowVectorXd P = G.transpose() * system_.e;
    ColumnMatrix shooting = (G.cwiseInverse() * P).cwiseProduct(rho).cwiseProduct(reflected_);
    shooting.array().colwise() *= 1 + 2 * returns_.array();
    ColumnMatrix gathering = rho.cwiseProduct(received_);
    subtract_squares(shooting);
    subtract_squares(gathering);
    const Eigen::RowVectorXd scale = G.transpose() * (system_.e + reflected_).cwiseAbs2();
    return plan_walks(std::move(shooting), std::move(gathering), system_.K.gram(), scale, most);
  }

 private:
  /// b of an exitance: shot from what is large enough to be found, and gathered once from that, since small unknowns
  /// are seldom found.
  ColumnMatrix reflected(const ColumnMatrix& e) {
    const Eigen::Map<const Eigen::VectorXd> G(system_.K.gram().data(), e.rows());
    const auto sequence = sequence_->replicate(used_++);
    Bounces bounces([&](const ColumnMatrix& power) { return std::make_unique<PowerTransfer>(system_, power); },
                    *sequence);
    const ColumnMatrix shot =
        G.cwiseInverse().asDiagonal() * bounces.incremental(G.asDiagonal() * e, potential_rays(system_, 0));
    draws_ += bounces.draws();
    return gathered_once(e + shot);
  }

  ColumnMatrix gathered_once(const ColumnMatrix& B) {
    constexpr std::uint64_t rays_each = 64;
    std::vector<double> u(static_cast<std::size_t>(system_.walks->dimensions()));
    ColumnMatrix b = ColumnMatrix::Zero(B.rows(), B.cols());
    for (Index i = 0; i < B.rows(); ++i)
      for (std::uint64_t k = 0; k < rays_each; ++k) {
        core::RandomNumbers numbers(gather_seed_, static_cast<std::uint32_t>(k), static_cast<std::uint64_t>(i));
        for (double& each : u) each = numbers.next();
        const std::optional<Index> j = system_.walks->from_element(i, u);
        if (j) b.row(i) += B.row(*j) / static_cast<double>(rays_each);
      }
    draws_ += rays_each * static_cast<std::uint64_t>(B.rows());
    return b.cwiseProduct(system_.R.reflectance());
  }

  /// xi, times as few walks as there are: the hits on i of 8 walks from it, once reflected.
  void count_returns(std::uint64_t seed) {
    constexpr std::uint64_t walks_each = 8;
    const ElementWalks walks(system_, ElementWalks::Score::collision);
    returns_ = Eigen::VectorXd::Zero(system_.e.rows());
    const auto scored = [&](Index i, const ElementWalks::ConstRow&, Index hit) {
      if (hit == i) returns_(i) += system_.R.reflectance().row(i).mean() / static_cast<double>(walks_each);
    };
    const WalkNumbers numbers{*sequence_, seed, 0, 0};
    WalkBatch batch([&](std::span<const WalkStart> starts) { return walks.gather(starts, numbers, scored); });
    for (Index i = 0; i < system_.e.rows(); ++i)
      for (std::uint64_t k = 0; k < walks_each; ++k) batch.add({i, WalkSequences::walk(k, i)});
    draws_ += batch.finish();
  }

  /// b² less, but no less than a hundredth is left: what is estimated may be off.
  void subtract_squares(ColumnMatrix& moments) const {
    moments = (moments - reflected_.cwiseAbs2()).cwiseMax(.01 * moments);
  }

  const System& system_;
  std::unique_ptr<core::SampleSequence> sequence_;
  std::uint64_t used_ = 0, draws_ = 0, gather_seed_ = 0;
  ColumnMatrix reflected_, received_;
  Eigen::VectorXd returns_;
};

/// The walks of a replication so far.
class Combined {
 public:
  Combined(const ElementWalks& walks, const WalkPlan& plan)
      : walks_(walks),
        plan_(plan),
        shot_(ColumnMatrix::Zero(plan.shooting.rows(), plan.shooting.cols())),
        gathered_(shot_) {}

  std::uint64_t add(std::uint64_t begin, std::uint64_t end, const WalkNumbers& numbers, const RoundStop& stop) {
    WalkBatch shooting([&](std::span<const WalkStart> starts) { return walks_.shoot(starts, numbers, shot_); });
    for (std::uint64_t k = begin; k < end; ++k) {
      stop.here(k);
      shooting.add({0, WalkSequences::walk(k)});
    }
    WalkBatch gathering([&](std::span<const WalkStart> starts) { return walks_.gather(starts, numbers, gathered_); });
    for (Index i = 0; i < shot_.rows(); ++i)
      for (std::uint64_t k = gathers(i, begin); k < gathers(i, end); ++k) {
        stop.here(k);
        gathering.add({i, WalkSequences::walk(k, i + 1)});
      }
    return shooting.finish() + gathering.finish();
  }

  /// b by all of them.
  ColumnMatrix mean(std::uint64_t shot) const {
    ColumnMatrix b = shot_ / static_cast<double>(shot);
    for (Index i = 0; i < b.rows(); ++i) {
      const std::uint64_t n = gathers(i, shot);
      if (n == 0) continue;
      const Eigen::RowVectorXd by_gathering = gathered_.row(i) / static_cast<double>(n);
      for (Index c = 0; c < b.cols(); ++c) {
        if (!(plan_.shooting(i, c) > 0)) continue;
        const double of_shooting = static_cast<double>(shot) / plan_.shooting(i, c),
                     of_gathering = static_cast<double>(n) / plan_.gathering(i, c);
        b(i, c) = (of_shooting * b(i, c) + of_gathering * by_gathering(c)) / (of_shooting + of_gathering);
      }
    }
    return b;
  }

 private:
  /// That i has when so many have shot.
  std::uint64_t gathers(Index i, std::uint64_t shot) const {
    return static_cast<std::uint64_t>(plan_.gathered(i) * static_cast<double>(shot));
  }

  const ElementWalks& walks_;
  const WalkPlan& plan_;
  ColumnMatrix shot_, gathered_;
};

/// For one that shoots: where the number of all is given, so many that there are some that shoot.
double most_that_gather(const StoppingRule& rule, int replications) {
  constexpr double shooting = 16;
  if (rule.samples == 0) return most_gathering_walks;
  return std::clamp(static_cast<double>(rule.samples) / (shooting * replications) - 1, 1.0, most_gathering_walks);
}

}  // namespace

WalkPlan plan_walks(ColumnMatrix shooting, ColumnMatrix gathering, std::span<const double> areas,
                    const Eigen::RowVectorXd& scale, double most) {
  const Eigen::Map<const Eigen::ArrayXd> G(areas.data(), shooting.rows());
  Eigen::ArrayXd of_shooting = Eigen::ArrayXd::Zero(shooting.rows()), of_gathering = of_shooting;
  for (Index c = 0; c < scale.size(); ++c) {
    if (!(scale(c) > 0)) continue;
    of_shooting += shooting.col(c).array() / scale(c);
    of_gathering += gathering.col(c).array() / scale(c);
  }
  double high = (G * of_shooting).sum(), low = 1e-12 * high;
  while (high > low * (1 + 1e-9)) {
    const double middle = std::sqrt(low * high);
    const bool more = surplus(middle, of_shooting, of_gathering, G) > 0 ||
                      core::ordered_sum(gathered_at(middle, of_shooting, of_gathering, G)) > most;
    (more ? low : high) = middle;
  }
  Eigen::VectorXd gathered = Eigen::VectorXd::Zero(shooting.rows());
  if (high > 0) gathered = gathered_at(high, of_shooting, of_gathering, G);
  return {std::move(shooting), std::move(gathering), std::move(gathered)};
}

SolverReport CombinedWalks::advance(const System& system, SolverState& state, const StoppingRule& rule,
                                    Run& run) const {
  require_walks(system, name());
  require_constants(system, name());
  require_solvable(system);
  require_replications(settings_);
  if (!prepare(system, state)) return {.why = SolverReport::Stopped::nothing_to_do};
  const ElementWalks walks(system, ElementWalks::Score::collision);
  const Pilot pilot(system, settings_, run);
  const WalkPlan plan = pilot.plan(most_that_gather(rule, settings_.replications));
  const WalkSequences numbers(settings_, core::derived_seed(run.seed, "random walks"), walks.first_numbers());
  std::vector<Combined> combined(static_cast<std::size_t>(settings_.replications), Combined(walks, plan));
  const auto add = [&](int r, std::uint64_t begin, std::uint64_t end, ColumnMatrix& sum, const RoundStop& stop) {
    Combined& of_one = combined[static_cast<std::size_t>(r)];
    const std::uint64_t draws = of_one.add(begin, end, numbers(r), stop);
    sum = static_cast<double>(end) * of_one.mean(end);
    return draws + (r == 0 && begin == 0 ? pilot.draws() : 0);
  };
  const double starts = 1 + core::ordered_sum(plan.gathered);
  const auto first = static_cast<std::uint64_t>(std::max(16.0, std::ceil(256 / starts)));
  return sample_in_rounds(system, state, rule, settings_, {first, static_cast<std::uint64_t>(std::ceil(starts)), add},
                          run);
}

}  // namespace interflect::solvers

#include "solvers/stochastic_ray.h"

#include <algorithm>
#include <vector>

#include "core/ordered_sum.h"
#include "core/random.h"
#include "solvers/power_transfer.h"
#include "solvers/sampled_rounds.h"
#include "solvers/system_check.h"

namespace interflect::solvers {
namespace {

/// 1 / (1 - mean rho), of the column that reflects most.
double haste_of(const System& system) {
  const Eigen::Map<const Eigen::RowVectorXd> G(system.K.gram().data(), system.e.rows());
  return 1 / std::max(.01, 1 - (G * system.R.reflectance()).maxCoeff() / core::ordered_sum(G));
}

/// A replication under way.
class Solution {
 public:
  Solution(const System& system, const core::SampleSequence& sequence)
      : haste_(haste_of(system)),
        emitted_(power_of(system.K.gram(), system.e)),
        bounces_(
            [&system](const ColumnMatrix& power) {
              return std::make_unique<PowerTransfer>(system, power, PowerTransfer::Lines::one_way,
                                                     half_by_area(power, system.K.gram()));
            },
            sequence) {}

  std::uint64_t draws() const { return bounces_.draws(); }
  const ColumnMatrix& reflected() const { return reflected_; }  ///< G (x - e)

  void add(std::uint64_t rays, const RoundStop& stop) {
    if (reflected_.size() == 0) {
      reflected_ = bounces_.incremental(emitted_, rays, [&] { stop.here(); });
      rays_ = rays;
      return;
    }
    const auto at_a_time = static_cast<std::uint64_t>(std::max<Index>(32, emitted_.rows()));
    for (std::uint64_t left = rays; left > 0;) {
      stop.here();
      const std::uint64_t m = left < 2 * at_a_time ? left : at_a_time;
      const double step = haste_ * static_cast<double>(m), tau = step / (static_cast<double>(rays_) + step);
      const ColumnMatrix said = bounces_.bounced(emitted_ + reflected_, m);
      reflected_ += tau * (said - reflected_);
      rays_ += m;
      left -= m;
    }
  }

 private:
  double haste_;
  ColumnMatrix emitted_, reflected_;
  Bounces bounces_;
  std::uint64_t rays_ = 0;
};

}  // namespace

SolverReport StochasticRay::advance(const System& system, SolverState& state, const StoppingRule& rule,
                                    Run& run) const {
  require_walks(system, name());
  require_constants(system, name());
  require_solvable(system);
  if (!prepare(system, state)) return {.why = SolverReport::Stopped::nothing_to_do};
  const auto sequences = sequences_for(settings_, core::derived_seed(run.seed, "stochastic ray"));
  std::vector<Solution> solutions;
  for (const auto& sequence : sequences) solutions.emplace_back(system, *sequence);
  const Eigen::Map<const Eigen::VectorXd> G(system.K.gram().data(), system.e.rows());
  const auto add = [&](int r, std::uint64_t begin, std::uint64_t end, ColumnMatrix& sum, const RoundStop& stop) {
    Solution& solution = solutions[static_cast<std::size_t>(r)];
    const std::uint64_t before = solution.draws();
    solution.add(end - begin, stop);
    sum = static_cast<double>(end) * G.cwiseInverse().asDiagonal() * solution.reflected();
    return solution.draws() - before;
  };
  return sample_in_rounds(system, state, rule, settings_, {256, 1, add}, run);
}

}  // namespace interflect::solvers

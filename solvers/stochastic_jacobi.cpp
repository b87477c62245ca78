#include "solvers/stochastic_jacobi.h"

#include <cmath>
#include <vector>

#include "core/error.h"
#include "core/random.h"
#include "solvers/power_transfer.h"
#include "solvers/sampled_rounds.h"
#include "solvers/system_check.h"

namespace interflect::solvers {
namespace {

/// What one replication does.
class Bounces {
 public:
  Bounces(const System& system, const core::SampleSequence& sequence, PowerTransfer::Lines lines)
      : system_(system), sequence_(sequence), lines_(lines) {}

  std::uint64_t draws() const { return draws_; }

  /// G (b - e) by bounces of bounces: `rays` for what is emitted, and for all that follows as many as its power asks for.
  ColumnMatrix incremental(std::uint64_t rays) {
    constexpr double left = 1e-7;
    const ColumnMatrix emitted = power_of(system_.K.gram(), system_.e);
    ColumnMatrix sum = ColumnMatrix::Zero(emitted.rows(), emitted.cols()), last = emitted;
    for (double share = 1; share > left; share = largest_share(last, emitted)) {
      last = bounced(last, static_cast<std::uint64_t>(std::ceil(share * static_cast<double>(rays))));
      sum += last;
    }
    return sum;
  }
  /// What one bounce of a power reflects.  By a randomisation of its own: points of one sequence know of each other, and
  /// what is sent here was found by earlier ones, so that their means would be off.
  ColumnMatrix bounced(const ColumnMatrix& power, std::uint64_t rays) {
    ColumnMatrix reflected = ColumnMatrix::Zero(power.rows(), power.cols());
    PowerTransfer(system_, power, lines_).add(*sequence_.replicate(bounces_++), 0, rays, 1, reflected);
    draws_ += rays;
    return reflected;
  }

 private:
  static double largest_share(const ColumnMatrix& power, const ColumnMatrix& of) {
    double largest = 0;
    for (Index c = 0; c < power.cols(); ++c)
      if (const double all = of.col(c).cwiseAbs().sum(); all > 0)
        largest = std::max(largest, power.col(c).cwiseAbs().sum() / all);
    return largest;
  }

  const System& system_;
  const core::SampleSequence& sequence_;
  PowerTransfer::Lines lines_;
  std::uint64_t bounces_ = 0, draws_ = 0;
};

}  // namespace

std::string StochasticJacobi::name() const {
  switch (kind_) {
    case Kind::regular:
      return "regular-stochastic-jacobi";
    case Kind::bidirectional:
      return "bidirectional-stochastic-jacobi";
    case Kind::incremental:
      break;
  }
  return "stochastic-jacobi";
}

SolverReport StochasticJacobi::advance(const System& system, SolverState& state, const StoppingRule& rule,
                                       Run& run) const {
  require_walks(system, name());
  require_solvable(system);
  const bool both_ways = kind_ == Kind::bidirectional, anew_each_time = kind_ == Kind::incremental;
  if (both_ways && !system.K.symmetric())
    throw core::InputError("solver '" + name() + "'", "a symmetric operator expected; use 'stochastic-jacobi' here");
  if (!prepare(system, state)) return {.why = SolverReport::Stopped::nothing_to_do};

  const auto sequences = sequences_for(settings_, core::derived_seed(run.seed, "stochastic jacobi"));
  std::vector<Bounces> bounces;
  const auto lines = both_ways ? PowerTransfer::Lines::both_ways : PowerTransfer::Lines::one_way;
  for (const auto& sequence : sequences) bounces.emplace_back(system, *sequence, lines);
  std::vector<ColumnMatrix> last(bounces.size());  // G (b - e) of the last iteration
  const Eigen::Map<const Eigen::VectorXd> G(system.K.gram().data(), system.e.rows());
  const ColumnMatrix emitted = power_of(system.K.gram(), system.e);
  const auto add = [&](int r, std::uint64_t begin, std::uint64_t end, ColumnMatrix& sum) {
    const auto k = static_cast<std::size_t>(r);
    const std::uint64_t before = bounces[k].draws(), rays = end - begin;
    const bool anew = anew_each_time || begin == 0;
    last[k] = anew ? bounces[k].incremental(rays) : bounces[k].bounced(emitted + last[k], rays);
    sum += static_cast<double>(rays) * G.cwiseInverse().asDiagonal() * last[k];
    return bounces[k].draws() - before;
  };
  return sample_in_rounds(system, state, rule, settings_, {256, 1, add}, run);
}

}  // namespace interflect::solvers

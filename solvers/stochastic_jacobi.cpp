#include "solvers/stochastic_jacobi.h"

#include <algorithm>
#include <vector>

#include "core/error.h"
#include "core/random.h"
#include "solvers/constant_control_variate.h"
#include "solvers/line_transfer.h"
#include "solvers/potential.h"
#include "solvers/ray_transfer.h"
#include "solvers/sampled_rounds.h"
#include "solvers/system_check.h"

namespace interflect::solvers {

std::string StochasticJacobi::name() const {
  switch (kind_) {
    case Kind::regular:
      return "regular-stochastic-jacobi";
    case Kind::bidirectional:
      return "bidirectional-stochastic-jacobi";
    case Kind::control_variate:
      return "control-variate-stochastic-jacobi";
    case Kind::global_lines:
      return "global-line-stochastic-jacobi";
    case Kind::importance_driven:
      return "importance-driven-stochastic-jacobi";
    case Kind::incremental:
      break;
  }
  return "stochastic-jacobi";
}

BounceFactory StochasticJacobi::bounces_of(const System& system, const ColumnMatrix& worth, const Run& run) const {
  switch (kind_) {
    case Kind::bidirectional:
      require_constants(system, name());
      if (!system.K.symmetric())
        throw core::InputError("solver '" + name() + "'",
                               "a symmetric operator expected; use 'stochastic-jacobi' here");
      return [&system](const ColumnMatrix& power) {
        return std::make_unique<PowerTransfer>(system, power, PowerTransfer::Lines::both_ways);
      };
    case Kind::control_variate:
      require_constants(system, name());
      require_closed(system, name(), run);
      return [&system](const ColumnMatrix& power) {
        return std::make_unique<ConstantControlVariate>(system, power, ray_transfer(system));
      };
    case Kind::global_lines:
      require_constants(system, name());
      require_lines(system, name());
      return [&system](const ColumnMatrix& power) { return std::make_unique<LineTransfer>(system, power); };
    case Kind::importance_driven:
      require_constants(system, name());
      require_target(system, name());
      return [&system, &worth](const ColumnMatrix& power) {
        return std::make_unique<PowerTransfer>(system, power, PowerTransfer::Lines::one_way,
                                               power.cwiseProduct(defensive(worth, power)));
      };
    case Kind::incremental:
    case Kind::regular:
      break;
  }
  return ray_transfer(system);
}

SolverReport StochasticJacobi::advance(const System& system, SolverState& state, const StoppingRule& rule,
                                       Run& run) const {
  require_walks(system, name());
  require_solvable(system);
  require_replications(settings_);
  if (!prepare(system, state)) return {.why = SolverReport::Stopped::nothing_to_do};
  ColumnMatrix worth;
  const BounceFactory of = bounces_of(system, worth, run);

  const auto sequences = sequences_for(settings_, core::derived_seed(run.seed, "stochastic jacobi"));
  std::vector<Bounces> bounces;
  for (const auto& sequence : sequences) bounces.emplace_back(of, *sequence);
  std::vector<ColumnMatrix> last(bounces.size());  // G (b - e) of the last iteration
  const Eigen::Map<const Eigen::VectorXd> G(system.K.gram().data(), system.e.rows());
  const ColumnMatrix emitted = power_of(system.K.gram(), system.e);
  const auto add = [&](int r, std::uint64_t begin, std::uint64_t end, ColumnMatrix& sum, const RoundStop& stop) {
    const auto k = static_cast<std::size_t>(r);
    const std::uint64_t before = bounces[k].draws(), samples = end - begin;
    const bool anew = kind_ == Kind::incremental || kind_ == Kind::importance_driven || begin == 0;
    stop.here();
    last[k] = anew ? bounces[k].incremental(emitted, samples, [&] { stop.here(); })
                   : bounces[k].bounced(emitted + last[k], samples);
    sum += static_cast<double>(samples) * G.cwiseInverse().asDiagonal() * last[k];
    return bounces[k].draws() - before;
  };
  // Bounces pass over all unknowns: with far fewer samples that is all that takes time.
  SampledRounds rounds{std::max<std::uint64_t>(256, static_cast<std::uint64_t>(system.e.rows()) / 8), 1, add};
  if (kind_ == Kind::importance_driven)
    rounds.prepare = [&](std::uint64_t begin, std::uint64_t end, const RoundStop& stop) {
      Potential potential(system, settings_, run,
                          potential_rays(system, (end - begin) * static_cast<std::uint64_t>(bounces.size())),
                          [&] { stop.here(); });
      worth = potential.of_a_bounce();
      return potential.draws();
    };
  else
    rounds.first = std::max(rounds.first, of(emitted)->least_samples());
  return sample_in_rounds(system, state, rule, settings_, rounds, run);
}

}  // namespace interflect::solvers

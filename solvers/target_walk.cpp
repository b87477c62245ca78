#include "solvers/target_walk.h"

#include "core/random.h"
#include "solvers/potential.h"
#include "solvers/sampled_rounds.h"
#include "solvers/system_check.h"

namespace interflect::solvers {

std::string TargetWalk::name() const {
  switch (way_) {
    case Way::optimal_sources:
      return "optimal-sources";
    case Way::potential_driven:
      return "potential-driven";
    case Way::adjoint:
      break;
  }
  return "adjoint";
}

SolverReport TargetWalk::advance(const System& system, SolverState& state, const StoppingRule& rule, Run& run) const {
  require_target(system, name());
  require_walks(system, name());
  require_constants(system, name());
  require_solvable(system);
  if (!prepare(system, state)) return {.why = SolverReport::Stopped::nothing_to_do};
  return way_ == Way::adjoint ? gather(system, state, rule, run) : shoot(system, state, rule, run);
}

SolverReport TargetWalk::shoot(const System& system, SolverState& state, const StoppingRule& rule, Run& run) const {
  ElementWalks walks(system, ElementWalks::Score::collision);
  const WalkSequences numbers(settings_, core::derived_seed(run.seed, "random walks"), walks.first_numbers());
  const auto add = [&](int r, std::uint64_t begin, std::uint64_t end, ColumnMatrix& sum, const RoundStop& stop) {
    WalkBatch batch([&](std::span<const WalkStart> starts) { return walks.shoot(starts, numbers(r), sum); });
    for (std::uint64_t k = begin; k < end; ++k) {
      stop.here(k);
      batch.add({0, WalkSequences::walk(k)});
    }
    return batch.finish();
  };
  const auto prepare = [&](std::uint64_t begin, std::uint64_t end, const RoundStop& stop) {
    Potential potential(system, settings_, run,
                        potential_rays(system, (end - begin) * static_cast<std::uint64_t>(settings_.replications)),
                        [&] { stop.here(); });
    if (way_ == Way::potential_driven)
      walks.prefer_ways(potential.of_a_walk());
    else
      walks.prefer_sources(potential.of_a_walk());
    return potential.draws();
  };
  return sample_in_rounds(system, state, rule, settings_, {256, 1, add, prepare}, run);
}

SolverReport TargetWalk::gather(const System& system, SolverState& state, const StoppingRule& rule, Run& run) const {
  const ElementWalks walks(system, ElementWalks::Score::collision);
  const Eigen::Map<const Eigen::VectorXd> t(system.target.data(), system.e.rows());
  const PowerDraw starts(t.asDiagonal() * system.R.reflectance());
  const WalkSequences numbers(settings_, core::derived_seed(run.seed, "random walks"), 1 + walks.first_numbers(), 1);
  const auto add = [&](int r, std::uint64_t begin, std::uint64_t end, ColumnMatrix& sum, const RoundStop& stop) {
    const auto scored = [&](Index i, const ElementWalks::ConstRow& score, Index) {
      sum.row(i) += score / starts.probability(i);
    };
    const WalkNumbers of_walks = numbers(r);
    WalkBatch batch([&](std::span<const WalkStart> of_batch) { return walks.gather(of_batch, of_walks, scored); });
    for (std::uint64_t k = begin; k < end && !starts.nothing(); ++k) {
      stop.here(k);
      double first = 0;
      of_walks.sequence.point(WalkSequences::walk(k), {&first, 1});
      batch.add({starts(first).unknown, WalkSequences::walk(k)});
    }
    return batch.finish();
  };
  SampledRounds rounds{256, 1, add};
  for (Index i = 0; i < system.e.rows(); ++i)
    if (starts.nothing() || !(starts.probability(i) > 0)) rounds.unanswered.push_back(i);
  return sample_in_rounds(system, state, rule, settings_, rounds, run);
}

}  // namespace interflect::solvers

#include "solvers/random_walk.h"

#include "core/error.h"
#include "core/random.h"
#include "solvers/sampled_rounds.h"
#include "solvers/system_check.h"

namespace interflect::solvers {

static void require_answerable(const System& system, RandomWalk::Way way, RandomWalk::Score score,
                               const std::string& name) {
  const ColumnMatrix& rho = system.R.reflectance();
  if (score == RandomWalk::Score::absorption && (rho.array() >= 1).any())
    throw core::InputError("solver '" + name + "'", "what reflects everything absorbs nothing to count: another score");
  if (way == RandomWalk::Way::gathering && score == RandomWalk::Score::survival &&
      (rho.array() == 0 && system.e.array() != 0).any())
    throw core::InputError("solver '" + name + "'", "a source that reflects nothing is not found: another score");
}

std::string RandomWalk::name() const {
  const char* score = score_ == Score::absorption ? "absorption" : score_ == Score::survival ? "survival" : "collision";
  if (way_ == Way::continuous) return "continuous-shooting";
  return std::string(way_ == Way::shooting ? "shooting-" : "gathering-") + score;
}

SolverReport RandomWalk::advance(const System& system, SolverState& state, const StoppingRule& rule, Run& run) const {
  require_walks(system, name());
  require_constants(system, name());
  if (way_ == Way::continuous) require_points(system, name());
  require_solvable(system);
  require_answerable(system, way_, score_, name());
  if (!prepare(system, state)) return {.why = SolverReport::Stopped::nothing_to_do};

  const ElementWalks walks(system, score_);
  const WalkSequences numbers(settings_, core::derived_seed(run.seed, "random walks"), walks.first_numbers());
  const auto some = [&](std::span<const WalkStart> starts, const WalkNumbers& of_walks, ColumnMatrix& sum) {
    switch (way_) {
      case Way::shooting:
        return walks.shoot(starts, of_walks, sum);
      case Way::continuous:
        return walks.shoot_on(starts, of_walks, sum);
      case Way::gathering:
        break;
    }
    return walks.gather(starts, of_walks, sum);
  };
  const Index starts = way_ == Way::gathering ? system.e.rows() : 1;
  const auto add = [&](int r, std::uint64_t begin, std::uint64_t end, ColumnMatrix& sum, const RoundStop& stop) {
    WalkBatch batch([&](std::span<const WalkStart> of_batch) { return some(of_batch, numbers(r), sum); });
    for (std::uint64_t k = begin; k < end; ++k)
      for (Index i = 0; i < starts; ++i) {
        stop.here(k + static_cast<std::uint64_t>(i));
        batch.add({i, WalkSequences::walk(k, i)});
      }
    return batch.finish();
  };
  const SampledRounds rounds{way_ == Way::gathering ? 4u : 256u, static_cast<std::uint64_t>(starts), add};
  return sample_in_rounds(system, state, rule, settings_, rounds, run);
}

}  // namespace interflect::solvers

#include "solvers/sampled_rounds.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "core/error.h"
#include "solvers/iterations.h"
#include "solvers/replications.h"

namespace interflect::solvers {
namespace {

/// sqrt(sum G error²) / sqrt(sum G x²), the largest of the columns that are lit.
double relative_noise(const System& system, const ColumnMatrix& error, const ColumnMatrix& x) {
  const Eigen::Map<const Eigen::RowVectorXd> G(system.K.gram().data(), x.rows());
  const Eigen::RowVectorXd squares = G * error.cwiseAbs2(), sizes = G * x.cwiseAbs2();
  double largest = 0;
  for (Index c = 0; c < sizes.size(); ++c)
    if (sizes(c) > 0) largest = std::max(largest, std::sqrt(squares(c) / sizes(c)));
  return largest;
}

}  // namespace

SolverReport sample_in_rounds(const System& system, SolverState& state, const StoppingRule& rule,
                              const SolverSettings& settings, const SampledRounds& rounds, Run& run) {
  if (settings.replications < 10)
    throw core::InputError("solvers that sample", "10 replications or more expected: errors are by how they differ");
  Replications replications(system.e.rows(), system.e.cols(), settings.replications);
  const std::uint64_t of_one = rounds.starts_a_sample * static_cast<std::uint64_t>(replications.count());
  const std::uint64_t most = rule.samples > 0 ? std::max<std::uint64_t>(1, rule.samples / of_one) : 0;
  Iterations iterations(state, rule, run);
  std::uint64_t done = 0, next = rounds.first;
  for (bool more = true; more; next = 2 * done) {
    if (most > 0) next = std::min(next, most);
    std::atomic<std::uint64_t> draws = 0;
    replications.add(run, [&](int r, ColumnMatrix& sum) { draws += rounds.add(r, done, next, sum); });
    done = next;
    ColumnMatrix x = system.e + replications.mean(static_cast<double>(done));
    state.standard_error = replications.standard_error(static_cast<double>(done));
    const double noise = relative_noise(system, state.standard_error, x);
    more = iterations.next(x, {noise, static_cast<double>(draws), most > 0 ? done == most : noise <= rule.noise});
  }
  return iterations.report();
}

std::vector<std::unique_ptr<core::SampleSequence>> sequences_for(const SolverSettings& settings, std::uint64_t seed) {
  const auto first = core::make_sequence(settings.sequence, seed);
  std::vector<std::unique_ptr<core::SampleSequence>> sequences;
  for (int r = 0; r < settings.replications; ++r) sequences.push_back(first->replicate(static_cast<std::uint64_t>(r)));
  return sequences;
}

}  // namespace interflect::solvers

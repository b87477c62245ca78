#include "solvers/sampled_rounds.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <tuple>

#include "core/error.h"
#include "solvers/replications.h"
#include "solvers/round_progress.h"
#include "solvers/system_check.h"

namespace interflect::solvers {
namespace {

/// Draws by which what is there is found: what is not may be nothing.
constexpr double enough_to_find = 1 << 21;

/// sqrt(sum G error²) / sqrt(sum G b²) of what is reflected, the largest of the columns; 1 of those that could have
/// some, of which few draws have found none.
double relative_noise(const System& system, const ColumnMatrix& error, const ColumnMatrix& reflected, double draws) {
  const Eigen::Map<const Eigen::RowVectorXd> G(system.K.gram().data(), error.rows());
  const Eigen::RowVectorXd squares = G * error.cwiseAbs2(), sizes = G * reflected.cwiseAbs2();
  double largest = 0;
  for (Index c = 0; c < sizes.size(); ++c)
    if (sizes(c) > 0)
      largest = std::max(largest, std::sqrt(squares(c) / sizes(c)));
    else if (draws < enough_to_find && !(system.e.col(c).array() == 0).all() &&
             !(system.R.reflectance().col(c).array() == 0).all())
      largest = std::max(largest, 1.0);
  return largest;
}

/// The same of what is asked for, which is set.
double target_noise(const System& system, SolverState& state, const Replications& replications, std::uint64_t done,
                    double draws) {
  const Eigen::Map<const Eigen::RowVectorXd> t(system.target.data(), system.e.rows());
  std::tie(state.target, state.target_error) = replications.weighed(system.target, static_cast<double>(done));
  state.target += t * system.e;
  double largest = 0;
  for (Index c = 0; c < state.target.size(); ++c) {
    const bool dark = (system.e.col(c).array() == 0).all() || (t.array() == 0).all();
    if (state.target_error(c) > 0 && state.target(c) != 0)
      largest = std::max(largest, state.target_error(c) / std::abs(state.target(c)));
    else if (!dark && draws < enough_to_find)
      largest = 1;
  }
  return largest;
}

/// w of w^T x, the power of all elements: G of their first functions, which are constant.
std::vector<double> power_weights(const System& system) {
  const std::vector<Index>& first = system.K.layout().first_of_element;
  std::vector<double> w(static_cast<std::size_t>(system.e.rows()), 0.0);
  for (std::size_t i = 0; i + 1 < first.size(); ++i) {
    const auto a = static_cast<std::size_t>(first[i]);
    w[a] = system.K.gram()[a];
  }
  return w;
}

void nothing_yet(const System& system, SolverState& state) {
  constexpr double unknown = std::numeric_limits<double>::infinity();
  state.x = system.e;
  state.standard_error = ColumnMatrix::Constant(system.e.rows(), system.e.cols(), unknown);
  state.power_error = state.target_error = Eigen::RowVectorXd::Constant(system.e.cols(), unknown);
  state.target = Eigen::RowVectorXd::Zero(system.e.cols());
}

}  // namespace

SolverReport sample_in_rounds(const System& system, SolverState& state, const StoppingRule& rule,
                              const SolverSettings& settings, const SampledRounds& rounds, Run& run) {
  require_replications(settings);
  Replications replications(system.e.rows(), system.e.cols(), settings.replications);
  const std::uint64_t of_one = rounds.starts_a_sample * static_cast<std::uint64_t>(replications.count());
  const std::uint64_t most = rule.samples > 0 ? std::max<std::uint64_t>(1, rule.samples / of_one) : 0;
  Iterations iterations(state, rule, run);
  const RoundStop stop(iterations);
  std::uint64_t done = 0, next = rounds.first;
  double drawn = 0;
  const std::vector<double> of_power = power_weights(system);
  RoundProgress progress(run.progress);
  if (most > 0) progress.expect(static_cast<double>(most));
  for (bool more = true; more; next = 2 * done) {
    if (most > 0) next = std::min(next, most);
    std::atomic<std::uint64_t> draws = 0;
    try {
      if (rounds.prepare) draws = rounds.prepare(done, next, stop);
      replications.add(run, [&](int r, ColumnMatrix& sum) {
        draws += rounds.add(r, done, next, sum, stop);
        progress.add(static_cast<double>(next - done) / replications.count());
      });
    } catch (const RoundStop::Asked&) {
      if (done == 0) nothing_yet(system, state);
      return iterations.given_up();
    }
    done = next;
    ColumnMatrix x = system.e + replications.mean(static_cast<double>(done));
    state.standard_error = replications.standard_error(static_cast<double>(done));
    state.power_error = replications.weighed(of_power, static_cast<double>(done)).second;
    for (const Index i : rounds.unanswered)
      state.standard_error.row(i).setConstant(std::numeric_limits<double>::infinity());
    drawn += static_cast<double>(draws);
    const double noise = system.target.empty() ? relative_noise(system, state.standard_error, x - system.e, drawn)
                                               : target_noise(system, state, replications, done, drawn);
    if (most == 0) progress.expect_by(noise, rule.noise);
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

#include "fem/closure.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/format.h"
#include "core/ordered_sum.h"
#include "fem/closure_law.h"

namespace interflect::fem {
namespace {

using Vector = ClosureLaw::Vector;

constexpr int most_gradient_steps = 500;
constexpr int most_halvings = 30;
// Rays are counted: an opening that none of them finds though 16 should (environment_column.h) has the chance exp(-16).
constexpr double standard_deviations = 8;
constexpr double explained_deviations = 3;  // of the environment, in a row, that need no other reason
constexpr double least_stiffness =
    1e-8;  // of what a row had at first, which counts where all its entries are at their bounds

struct Entry {
  const char* name;
  std::unique_ptr<ClosureLaw> (*make)(const SymmetricOperator&, const EnvironmentColumn*, const EntryVariances&, Run&);
};
constexpr Entry catalogue[] = {{"scaling", scaling_law}, {"least-squares", least_squares_law}};

std::unique_ptr<ClosureLaw> make_law(const std::string& method, const SymmetricOperator& K,
                                     const EnvironmentColumn* environment, const EntryVariances& variances, Run& run) {
  for (const Entry& entry : catalogue)
    if (method == entry.name) return entry.make(K, environment, variances, run);
  throw core::InputError("closure by '" + method + "'", "one of scaling, least-squares expected");
}

double dot(const Vector& a, const Vector& b) { return a.cwiseProduct(b).sum(); }

/// Solves (diag(stiffness) + phi') step = missing by conjugate gradients with the diagonal as preconditioner, until the
/// residual is `reduction` of the right-hand side.  The matrix is positive semidefinite: singular where elements form
/// two groups that see each other only, and then consistent exactly if both have the same area.
Vector newton_step(const ClosureLaw& law, const Vector& diagonal, const Vector& missing, double reduction) {
  Vector step = Vector::Zero(missing.rows(), 1), residual = missing, direction = missing.array() / diagonal.array();
  double size = dot(residual, direction);
  const double enough = reduction * reduction * size;
  for (int k = 0; k < most_gradient_steps && size > enough; ++k) {
    const Vector image = diagonal.array() * direction.array() + law.times(direction).array();
    const double curvature = dot(direction, image);
    if (!(curvature > 0)) break;
    step += size / curvature * direction;
    residual -= size / curvature * image;
    const Vector preconditioned = residual.array() / diagonal.array();
    const double next = dot(residual, preconditioned);
    direction = preconditioned + next / size * direction;
    size = next;
  }
  return step;
}

/// Newton's method: multipliers with which rows add up to the areas.  Returns its steps.
int balance(ClosureLaw& law, std::span<const double> areas, double tolerance, int max_iterations, const Run& run) {
  Vector u = Vector::Zero(law.size(), 1);
  law.set(u);
  Vector first = law.stiffness();
  for (Index a = 0; a < law.size(); ++a)
    if (!(first(a, 0) > 0)) first(a, 0) = areas[static_cast<std::size_t>(a)];
  for (int iteration = 0;; ++iteration) {
    const double error = law.row_error();
    if (error <= tolerance || iteration == max_iterations) return iteration;
    run.throw_if_stopped("closure");
    const Vector diagonal = (law.stiffness().array() > least_stiffness * first.array()).select(law.stiffness(), first);
    const Vector step = newton_step(law, diagonal, law.missing(), std::clamp(0.1 * error, 1e-8, 1e-2));
    // Until the largest error falls, or the convex function still does at the end of the step.
    double length = 1;
    for (int halving = 0;; ++halving, length /= 2) {
      if (halving == most_halvings) {
        law.set(u);
        return iteration;
      }
      law.set(u + length * step);
      if (law.row_error() < error || dot(law.missing(), step) >= 0) break;
    }
    u += length * step;
  }
}

/// 1 - sum_b F_ab - F_a,env - dropped_a
std::vector<double> misclosure_of(std::span<const double> row_sum, const EnvironmentColumn* environment,
                                  std::span<const double> dropped) {
  std::vector<double> off;
  for (std::size_t a = 0; a < row_sum.size(); ++a)
    off.push_back(1 - row_sum[a] - (environment == nullptr ? 0 : environment->factor[a]) -
                  (dropped.empty() ? 0 : dropped[a]));
  return off;
}

/// Of what rows are off by, what says something of them: not what the environment's own noise explains.
std::vector<double> beyond_noise(std::span<const double> misclosure, const EnvironmentColumn* environment) {
  std::vector<double> seen;
  for (std::size_t a = 0; a < misclosure.size(); ++a) {
    const double noise = environment == nullptr ? 0 : explained_deviations * environment->standard_error[a];
    seen.push_back(std::max(0.0, std::abs(misclosure[a]) - noise));
  }
  return seen;
}

/// What an operator's rows may be off by, for what was not sampled: stated bounds, and what was left out.
std::vector<double> row_bounds(Index size, std::span<const double> stated, std::span<const double> dropped) {
  std::vector<double> bounds(stated.begin(), stated.end());
  bounds.resize(static_cast<std::size_t>(size), 0.0);
  for (std::size_t a = 0; a < dropped.size(); ++a) bounds[a] += dropped[a];
  return bounds;
}

void require_nearly_closed(std::span<const double> misclosure, std::span<const double> dropped, double limit) {
  for (std::size_t a = 0; a < misclosure.size(); ++a)
    if (!(std::abs(misclosure[a]) <= limit))
      throw core::InputError(core::format(
          "closure of %zu elements: the form factors of element %zu add up to %.4g%s; only a closed scene, "
          "with sums from %.4g to %.4g, can be corrected",
          misclosure.size(), a, 1 - misclosure[a],
          dropped.empty() ? "" : core::format(", and %.3g were dropped", dropped[a]).c_str(), 1 - limit, 1 + limit));
}

void require_explained(const SymmetricOperator& K, std::span<const double> misclosure,
                       const EnvironmentColumn& environment, std::span<const double> bound, Run& run) {
  Vector variance(K.size(), 1);
  K.apply_variances(Vector::Ones(K.size(), 1), variance, run);
  for (std::size_t a = 0; a < misclosure.size(); ++a) {
    const double noise = std::sqrt(variance(static_cast<Index>(a), 0)) / K.gram()[a];
    const double explained = bound[a] + standard_deviations * std::hypot(noise, environment.standard_error[a]);
    if (!(std::abs(misclosure[a]) <= explained))
      throw core::InputError(core::format(
          "closure of %td elements: the form factors of element %zu and what rays find of its environment add up to "
          "%.4g; errors explain %.4g to %.4g, and no more can be corrected",
          K.size(), a, 1 - misclosure[a], 1 - explained, 1 + explained));
  }
}

/// ||K' - K|| / ||K||, Frobenius.
double relative_change(const SymmetricOperator& K, const ClosureLaw& law, const Run& run) {
  const solvers::ColumnMatrix squares = K.sums_by_row(run, 2, [&](const StoredPair& p, solvers::ColumnMatrix& to) {
    const double d = law.repaired(p) - p.K, both = p.a == p.b ? 1 : 2;
    to(p.a, 0) += both * d * d;
    to(p.a, 1) += both * p.K * p.K;
  });
  const double whole = core::ordered_sum(squares.col(1));
  return whole > 0 ? std::sqrt(core::ordered_sum(squares.col(0)) / whole) : 0.0;
}

double largest(std::span<const double> values) {
  double most = 0;
  for (const double value : values) most = std::max(most, std::abs(value));
  return most;
}

/// A repair of K, balanced, that is yet to be made.
class Repair {
 public:
  /// @param dropped  taken for exchange that the rows have, too; empty: rows of K and the environment are to be 1 alone
  Repair(const SymmetricOperator& K, const EnvironmentColumn* environment, std::span<const double> dropped,
         const ClosureSettings& settings, Run& run)
      : K_(K), settings_(settings), off_(misclosure_of(K.row_sums(run), environment, dropped)) {
    const std::vector<double> bounds =
        row_bounds(K.size(), settings.row_bound, dropped.empty() ? K.dropped() : std::span<const double>());
    const EntryVariances variances = entry_variances(K, bounds, beyond_noise(off_, environment), K.row_sums(run), run);
    law_ = make_law(settings.method, K, environment, variances, run);
    Vector aside = Vector::Zero(K.size(), 1);
    for (std::size_t a = 0; a < dropped.size(); ++a) aside(static_cast<Index>(a), 0) = dropped[a] * K.gram()[a];
    law_->set_aside(std::move(aside));
    const double tolerance = settings.tolerance / 4;  // rounding needs its part, too
    iterations_ = balance(*law_, K.gram(), tolerance, settings.max_iterations, run);
    require_balanced();
  }

  const ClosureLaw& law() const { return *law_; }
  double row_error_before() const { return largest(off_); }
  int iterations() const { return iterations_; }
  std::vector<double> environment() const {
    std::vector<double> factors;
    for (Index a = 0; a < K_.size(); ++a)
      factors.push_back(law_->environment(a) / K_.gram()[static_cast<std::size_t>(a)]);
    return factors;
  }

 private:
  void require_balanced() const {
    const double left = law_->row_error();
    if (left > 1e-3 * row_error_before() && left > settings_.tolerance)
      throw core::InputError(
          core::format("closure of %td elements: no symmetric change of the form factors by %s makes every row sum 1 "
                       "(one is off by %.2g still)",
                       K_.size(), settings_.method.c_str(), left));
  }

  const SymmetricOperator& K_;
  const ClosureSettings& settings_;
  std::vector<double> off_;
  std::unique_ptr<ClosureLaw> law_;
  int iterations_ = 0;
};

/// What was dropped goes from element to element, and the environment has no part in it: its column as it is with those
/// entries in their rows, for K's own repair to keep.
EnvironmentColumn beside_dropped(const SymmetricOperator& K, const ClosureSettings& settings, Run& run) {
  const Repair with_dropped(K, settings.environment, K.dropped(), settings, run);
  return {with_dropped.environment(), std::vector<double>(static_cast<std::size_t>(K.size()), 0.0)};
}

/// What a repair may change: what errors may explain, and the part of a row that dropped entries are known to be.
double largest_change(const SymmetricOperator& K, std::span<const double> row_sum, const ClosureSettings& settings) {
  double share = 0;
  for (std::size_t a = 0; a < K.dropped().size(); ++a)
    if (row_sum[a] > 0) share = std::max(share, K.dropped()[a] / row_sum[a]);
  return settings.largest_correction + share;
}

/// ||K' - K|| / ||K||, Frobenius.
double accepted_change(const SymmetricOperator& K, const ClosureLaw& law, double most, const Run& run) {
  const double correction = relative_change(K, law, run);
  if (!(correction <= most))
    throw core::InputError(core::format(
        "closure of %td elements: it would change the form factors by %.3g of their norm, more than the %.3g "
        "that errors may explain",
        law.size(), correction, most));
  return correction;
}

}  // namespace

std::vector<std::string> closure_names() {
  std::vector<std::string> names;
  for (const Entry& entry : catalogue) names.emplace_back(entry.name);
  return names;
}

ClosureReport restore_closure(SymmetricOperator& K, Run& run, const ClosureSettings& settings) {
  const EnvironmentColumn* environment = settings.environment;
  const std::vector<double> row_sum = K.row_sums(run);
  EnvironmentColumn beside;
  if (environment == nullptr) {
    require_nearly_closed(misclosure_of(row_sum, nullptr, {}), K.dropped(), settings.largest_row_error);
  } else {
    require_explained(K, misclosure_of(row_sum, environment, K.dropped()), *environment,
                      row_bounds(K.size(), settings.row_bound, K.dropped()), run);
    if (!K.dropped().empty()) {
      beside = beside_dropped(K, settings, run);
      environment = &beside;
    }
  }
  const Repair repair(K, environment, {}, settings, run);
  ClosureReport report;
  report.row_error_before = largest(misclosure_of(row_sum, settings.environment, {}));
  report.iterations = repair.iterations();
  report.correction = accepted_change(K, repair.law(), largest_change(K, row_sum, settings), run);
  K.change([&](const StoredPair& pair) { return repair.law().repaired(pair); }, run);
  EnvironmentColumn after{repair.environment(), {}};
  report.row_error_after = largest(misclosure_of(K.row_sums(run), &after, {}));
  report.converged = report.row_error_after <= settings.tolerance;
  if (environment != nullptr) report.environment = std::move(after.factor);
  return report;
}

}  // namespace interflect::fem

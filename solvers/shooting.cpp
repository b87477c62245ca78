#include "solvers/shooting.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/ordered_sum.h"
#include "solvers/bounce.h"
#include "solvers/iterations.h"
#include "solvers/system_check.h"

namespace interflect::solvers {
namespace {

constexpr Index chunk = 4096;  ///< unknowns that one thread updates: less is not worth waking another

}  // namespace

Shooting::Shooting(const System& system, const std::string& solver, const ColumnMatrix& x, const ColumnMatrix& r,
                   const Run& run, double overshoot)
    : system_(system),
      access_(required_columns(system, solver)),
      run_(run),
      overshoot_(overshoot),
      ahead_(Eigen::VectorXd::Zero(x.cols())),
      x_(x.transpose()),
      r_(r.transpose()),
      by_area_(system.R.reflectance().transpose()),
      row_(ColumnMatrix::Zero(1, x.rows())),
      sparse_(overshoot > 0 ? nullptr : system.K.sparse_rows()),
      of_chunks_(static_cast<std::size_t>((x.rows() + chunk - 1) / chunk)),
      residual_of_chunks_(x.cols(), std::ssize(of_chunks_)),
      largest_x_(x_.cwiseAbs().rowwise().maxCoeff()) {
  for (Index a = 0; a < unknowns(); ++a) by_area_.col(a) /= system.K.gram()[static_cast<std::size_t>(a)];
  if (sparse_ == nullptr) {
    spread(Eigen::VectorXd::Zero(columns()));
    return;
  }
  by_power_.emplace(unknowns());
  by_residual_.assign(static_cast<std::size_t>(columns()), Tournament(unknowns()));
  for (Index a = 0; a < unknowns(); ++a) weigh(a);
}

double Shooting::unshot_fraction() const { return solvers::unshot_fraction(system_, r_.transpose()); }

double Shooting::relative_residual() const {
  double largest = 0;
  for (Index c = 0; c < columns(); ++c) {
    const double r = largest_residual(c);
    if (std::isnan(r)) return r;
    if (r > 0) largest = std::max(largest, largest_x_(c) > 0 ? r / largest_x_(c) : 1.0);
  }
  return largest;
}

double Shooting::largest_residual(Index column) const {
  return sparse_ != nullptr ? by_residual_[static_cast<std::size_t>(column)].largest()
                            : residual_of_chunks_.row(column).maxCoeff<Eigen::PropagateNaN>();
}

void Shooting::step(Index i, const Eigen::VectorXd& d) {
  fetch(i);
  move(i, d);
  r_.col(i) -= d;
  if (sparse_ != nullptr) weigh(i);
  spread(d);
}

void Shooting::relax(Index i) {
  const double K_ii = fetch(i);
  Eigen::VectorXd d(columns());
  for (Index c = 0; c < columns(); ++c) d(c) = r_(c, i) / (1 - by_area_(c, i) * K_ii);
  move(i, d);
  r_.col(i).setZero();
  if (sparse_ != nullptr) weigh(i);
  if (std::isfinite(K_ii)) leave_out(i);
  spread(d);
}

/// Row i.  @return K_ii
double Shooting::fetch(Index i) {
  if (sparse_ == nullptr) {
    access_.rows(i, 1, row_);
    return row_(0, i);
  }
  sparse_->row(i, entries_);
  const auto at = std::lower_bound(entries_.begin(), entries_.end(), i,
                                   [](const RowEntry& entry, Index unknown) { return entry.unknown < unknown; });
  return at != entries_.end() && at->unknown == i ? at->K : 0.0;
}

/// What the row that was fetched has on the diagonal.
void Shooting::leave_out(Index i) {
  if (sparse_ == nullptr)
    row_(0, i) = 0;
  else
    std::erase_if(entries_, [&](const RowEntry& entry) { return entry.unknown == i; });
}

void Shooting::move(Index i, const Eigen::VectorXd& d) {
  for (Index c = 0; c < columns(); ++c) {
    const double before = std::abs(x_(c, i)), now = std::abs(x_(c, i) += d(c));
    if (now >= largest_x_(c))
      largest_x_(c) = now;
    else if (before == largest_x_(c))
      largest_x_(c) = x_.row(c).cwiseAbs().maxCoeff();
  }
}

void Shooting::spread(const Eigen::VectorXd& d) {
  if (sparse_ != nullptr) return spread_entries(d);
  const bool in_one_go = !(overshoot_ > 0);
  run_.threads.for_blocks(unknowns(), chunk, [&](Index begin, Index end) {
    spread(d, begin, end);
    if (in_one_go) scan(begin, end);
  });
  if (!in_one_go) {
    ahead_ = overshoot_ * ambient(system_, r_.transpose()).cwiseMax(0.0).transpose();
    run_.threads.for_blocks(unknowns(), chunk, [&](Index begin, Index end) { scan(begin, end); });
  }
  find_brightest();
}

void Shooting::spread(const Eigen::VectorXd& d, Index begin, Index end) {
  const Index count = end - begin;
  const auto K = row_.row(0).segment(begin, count).array();
  for (Index c = 0; c < columns(); ++c)
    r_.row(c).segment(begin, count).array() += d(c) * K * by_area_.row(c).segment(begin, count).array();
}

void Shooting::spread_entries(const Eigen::VectorXd& d) {
  for (const RowEntry& entry : entries_) {
    for (Index c = 0; c < columns(); ++c) r_(c, entry.unknown) += d(c) * entry.K * by_area_(c, entry.unknown);
    weigh(entry.unknown);
  }
}

/// Lets an unknown whose residual has changed play again.
void Shooting::weigh(Index a) {
  double power = 0;
  for (Index c = 0; c < columns(); ++c) {
    const double r = std::abs(r_(c, a));
    by_residual_[static_cast<std::size_t>(c)].set(a, r);
    power += r;
  }
  by_power_->set(a, power * system_.K.gram()[static_cast<std::size_t>(a)]);
}

/// rho_a = by_area_a G_a
Eigen::VectorXd Shooting::to_shoot(Index a) const {
  const double G = system_.K.gram()[static_cast<std::size_t>(a)];
  return r_.col(a) + G * by_area_.col(a).cwiseProduct(ahead_);
}

void Shooting::scan(Index begin, Index end) {
  const Index count = end - begin, k = begin / chunk;
  const Eigen::Map<const Eigen::RowVectorXd> G(system_.K.gram().data() + begin, count);
  Eigen::RowVectorXd power = Eigen::RowVectorXd::Zero(count);
  for (Index c = 0; c < columns(); ++c) {
    const auto r = r_.row(c).segment(begin, count);
    residual_of_chunks_(c, k) = r.cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
    if (ahead_(c) > 0)
      power += (r + ahead_(c) * by_area_.row(c).segment(begin, count).cwiseProduct(G)).cwiseAbs();
    else
      power += r.cwiseAbs();
  }
  Brightest& found = of_chunks_[static_cast<std::size_t>(k)];
  power = power.cwiseProduct(G);
  found.power = power.maxCoeff(&found.unknown);  // the first of equal ones
  found.unknown += begin;
}

void Shooting::find_brightest() {
  Brightest found;
  for (const Brightest& each : of_chunks_)
    if (each.power > found.power) found = each;
  brightest_ = found.unknown;
}

double unshot_fraction(const System& system, ConstColumns unshot) {
  const Eigen::Map<const Eigen::ArrayXd> G(system.K.gram().data(), unshot.rows());
  double largest = 0;
  for (Index c = 0; c < unshot.cols(); ++c) {
    const double all = (G * system.e.col(c).array().abs()).sum();
    if (all > 0) largest = std::max(largest, (G * unshot.col(c).array().abs()).sum() / all);
  }
  return largest;
}

Eigen::RowVectorXd ambient(const System& system, ConstColumns unshot) {
  const Eigen::Map<const Eigen::RowVectorXd> G(system.K.gram().data(), unshot.rows());
  const Eigen::RowVectorXd absorbing = core::ordered_sum(G) - (G * system.R.reflectance()).array();
  return (G * unshot).cwiseQuotient(absorbing);
}

Shooting begin_shooting(const System& system, const std::string& solver, const SolverState& state, Run& run,
                        double overshoot) {
  const ColumnMatrix nothing = ColumnMatrix::Zero(state.x.rows(), state.x.cols());
  if (state.residual.size() > 0) return {system, solver, state.x, state.residual, run, overshoot};
  if (state.x == system.e) return {system, solver, nothing, system.e, run, overshoot};
  required_columns(system, solver);
  return {system, solver, state.x, residual_of(system, state.x, run), run, overshoot};
}

namespace {

/// Also where anything is no number.
bool is_enough(const Shooting& shooting, const StoppingRule& rule) {
  return !(shooting.relative_residual() > rule.tolerance) ||
         (rule.unshot > 0 && shooting.unshot_fraction() <= rule.unshot);
}

}  // namespace

SolverReport solve_by_steps(const System& system, const std::string& solver, SolverState& state,
                            const StoppingRule& rule, Run& run, double overshoot, Index of_iteration,
                            const std::function<void(Shooting&, Index brightest)>& step) {
  require_solvable(system);
  if (!prepare(system, state)) return {.why = SolverReport::Stopped::nothing_to_do};
  Shooting shooting = begin_shooting(system, solver, state, run, overshoot);
  const Index most = of_iteration > 0 ? of_iteration : shooting.unknowns();
  Iterations iterations(state, rule, run);
  for (bool more = true; more;) {
    Index steps = 0;
    for (; steps < most && !is_enough(shooting, rule) && (steps == 0 || !iterations.interrupted()); ++steps)
      step(shooting, shooting.brightest());
    ColumnMatrix x = shooting.x(), r = shooting.residual();
    more = iterations.next(x, r, {shooting.relative_residual(), static_cast<double>(steps), is_enough(shooting, rule)});
  }
  return iterations.report();
}

}  // namespace interflect::solvers

#include "solvers/iterations.h"

#include <cmath>

#include "core/error.h"

namespace interflect::solvers {

namespace {

void require_finite(const Iterations::Outcome& outcome) {
  if (!std::isfinite(outcome.residual)) throw core::InputError("solve: the operator holds numbers that are not finite");
}

}  // namespace

bool Iterations::next(ColumnMatrix& x, const Outcome& outcome) {
  require_finite(outcome);
  state_.x.swap(x);
  return next(outcome);
}

bool Iterations::next(ColumnMatrix& x, ColumnMatrix& r, const Outcome& outcome) {
  require_finite(outcome);
  state_.x.swap(x);
  state_.residual.swap(r);
  return take_down(outcome);
}

bool Iterations::next(const Outcome& outcome) {
  require_finite(outcome);
  state_.residual.resize(0, 0);
  return take_down(outcome);
}

bool Iterations::interrupted() const { return run_.stop.stop_requested() || out_of_time(); }

/// The run's time counts as the rule's does.
SolverReport::Stopped Iterations::why_interrupted() const {
  const bool asked = run_.stop.stop_requested() && !run_.out_of_time();
  return asked ? SolverReport::Stopped::asked_to : SolverReport::Stopped::time_limit;
}

SolverReport Iterations::given_up() {
  report_.why = why_interrupted();
  return report();
}

bool Iterations::take_down(const Outcome& outcome) {
  ++state_.step;
  report_.history.push_back({outcome.residual, report_.rows() + outcome.rows, core::seconds_since(start_)});
  using Stopped = SolverReport::Stopped;
  bool more = false;
  if (outcome.enough || outcome.residual <= rule_.tolerance)
    report_.why = Stopped::converged;
  else if (report_.iterations() >= rule_.max_iterations)
    report_.why = Stopped::iteration_limit;
  else if (interrupted())
    report_.why = why_interrupted();
  else
    more = true;
  if (state_.observer) state_.observer(state_, report_);
  return more;
}

}  // namespace interflect::solvers

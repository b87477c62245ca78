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

SolverReport Iterations::given_up() {
  using Stopped = SolverReport::Stopped;
  report_.why = run_.stop.stop_requested() ? Stopped::asked_to : Stopped::time_limit;
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
  else if (run_.stop.stop_requested())
    report_.why = Stopped::asked_to;
  else if (out_of_time())
    report_.why = Stopped::time_limit;
  else
    more = true;
  if (state_.observer) state_.observer(state_, report_);
  return more;
}

}  // namespace interflect::solvers

#pragma once

#include <chrono>

#include "core/seconds_since.h"
#include "solvers/solver.h"

namespace interflect::solvers {

/// A solve under way: keeps its state good and its report true, iteration after iteration, and says when to stop.
class Iterations {
 public:
  /// All outlive this; the state holds the start.
  Iterations(SolverState& state, const StoppingRule& rule, const Run& run) : state_(state), rule_(rule), run_(run) {}

  /// What an iteration did.
  struct Outcome {
    double residual;      ///< that e + R G^-1 K x - x has, relative (relative_size)
    double rows;          ///< of K that it used
    bool enough = false;  ///< whatever the residual is
  };
  /// `x` goes into the state only where its residual is a number, so that a solve that fails leaves the last good x for
  /// another; what was there comes back in `x`.
  /// @return whether to go on
  /// @throws core::InputError  where the residual is not a number: K was not finite
  bool next(ColumnMatrix& x, const Outcome& outcome);
  /// The same with a residual that goes into the state.
  bool next(ColumnMatrix& x, ColumnMatrix& r, const Outcome& outcome);
  /// Of the x that the state holds already.
  bool next(const Outcome& outcome);
  /// Whether to end an iteration halfway: asked to, or out of time.
  bool interrupted() const;

  SolverReport report() { return std::move(report_); }
  /// The report of a solve whose last iteration was given up halfway, as if it had not begun.
  SolverReport given_up();

 private:
  bool out_of_time() const { return core::seconds_since(start_) >= rule_.max_seconds; }
  SolverReport::Stopped why_interrupted() const;
  bool take_down(const Outcome& outcome);

  SolverState& state_;
  const StoppingRule& rule_;
  const Run& run_;
  SolverReport report_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace interflect::solvers

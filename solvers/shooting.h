#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "solvers/solver.h"
#include "solvers/sparse_rows.h"
#include "solvers/tournament.h"

namespace interflect::solvers {

/// A solve by columns of K, one unknown a step: x, and with it the residual r = e + R G^-1 K x - x, which is what light
/// there is that was not shot yet.  A step from unknown i by d:
///
///   x_i += d,   r_i -= d,   r_a += rho_a / G_a K_ai d  for all a
///
/// needs column i of K alone, which is row i where K is symmetric, and leaves r true whatever d is.  All columns of x
/// share it: i is the unknown with the most power to shoot, the largest sum over them of G_i |r_i|; of equal ones the
/// first.  It is found while r is updated: by the threads that share a whole row, or, where K stores few entries of one
/// (`SparseRows`), by matches that are played again of those that it changes.  Both take the same steps, to the bit.
///
/// With overshooting what i has to shoot is r_i + s rho_i Amb, s the share asked for, where the ambient term
///
///   Amb = sum_a G_a r_a / sum_a (1 - rho_a) G_a
///
/// is positive: what the bounces of all that is unshot would bring, if they spread evenly.
/// Test: tests/solvers/shooting.cpp
class Shooting {
 public:
  /// @param x, r       what there is already; r that of x
  /// @param overshoot  s
  /// @throws core::InputError  as required_columns
  Shooting(const System& system, const std::string& solver, const ColumnMatrix& x, const ColumnMatrix& r,
           const Run& run, double overshoot = 0);

  Index unknowns() const { return x_.cols(); }
  Index columns() const { return x_.rows(); }
  Index brightest() const { return sparse_ != nullptr ? by_power_->winner() : brightest_; }
  Eigen::VectorXd unshot(Index a) const { return r_.col(a); }
  Eigen::VectorXd to_shoot(Index a) const;
  double unshot_fraction() const;
  /// max |r| / max |x|, as StoppingRule wants it; 1 of a column that has not begun.
  double relative_residual() const;

  /// @param d  one a column
  void step(Index i, const Eigen::VectorXd& d);
  /// So that r_i is 0 afterwards, to the bit: d_i = r_i / (1 - rho_i K_ii / G_i).
  void relax(Index i);

  ColumnMatrix x() const { return x_.transpose(); }
  ColumnMatrix residual() const { return r_.transpose(); }

 private:
  struct Brightest {
    double power = -1;
    Index unknown = 0;
  };
  void move(Index i, const Eigen::VectorXd& d);
  double fetch(Index i);
  void leave_out(Index i);
  double largest_residual(Index column) const;
  /// r_a += rho_a / G_a K_ai d by the row that was fetched, and what follows from it.
  void spread(const Eigen::VectorXd& d);
  void spread(const Eigen::VectorXd& d, Index begin, Index end);
  void scan(Index begin, Index end);
  void find_brightest();
  void spread_entries(const Eigen::VectorXd& d);
  void weigh(Index a);

  System system_;
  const RowAccess& access_;
  const Run& run_;
  double overshoot_;
  Eigen::VectorXd ahead_;         ///< s Amb, not below 0
  ColumnMatrix x_, r_, by_area_;  ///< columns x unknowns; rho_a / G_a
  ColumnMatrix row_;              ///< 1 x unknowns
  const SparseRows* sparse_;      ///< or null; with overshooting what all have to shoot changes with every step
  std::vector<RowEntry> entries_;
  std::optional<Tournament> by_power_;
  std::vector<Tournament> by_residual_;  ///< one a column
  std::vector<Brightest> of_chunks_;
  Eigen::MatrixXd residual_of_chunks_;  ///< max |r|, columns x chunks
  Eigen::VectorXd largest_x_;           ///< max |x|
  Index brightest_ = 0;
};

/// Steps until a residual is small enough, or what is unshot, `of_iteration` of them an iteration (0: as many as there
/// are unknowns, about a sweep's work).  It begins where the state is if that has a residual; at x = 0 with r = e where
/// it holds e, as a fresh one does; else at its x.
SolverReport solve_by_steps(const System& system, const std::string& solver, SolverState& state,
                            const StoppingRule& rule, Run& run, double overshoot, Index of_iteration,
                            const std::function<void(Shooting&, Index brightest)>& step);
/// Where that begins.
Shooting begin_shooting(const System& system, const std::string& solver, const SolverState& state, Run& run,
                        double overshoot = 0);

/// sum G |r| / sum G |e|, the largest of the columns that shine.
double unshot_fraction(const System& system, ConstColumns unshot);

/// Amb of each column.
Eigen::RowVectorXd ambient(const System& system, ConstColumns unshot);

}  // namespace interflect::solvers

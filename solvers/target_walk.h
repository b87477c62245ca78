#pragma once

#include "solvers/element_walks.h"

namespace interflect::solvers {

/// Random walks for a target J = sum_a t_a b_a, scored at every hit (element_walks.h), of constants.
///
///   optimal_sources    are born at s in proportion to G_s e_s w_s, w_s² what a walk from s scores, squared, in the
///                      mean [Sbert 1997]:  V_J = (sum G e w)² - J_r²,  of J_r = sum t (b - e);  of all walks that
///                      shoot the least
///   potential_driven   moreover go on where that is worth it [Pattanaik, Mudur 1995]
///   adjoint            start at what is asked about, i drawn in proportion to |t_i| rho_i, and gather:
///                      V_J = T sum_i t_i sum_s (e_s + 2 b_s) b_is - J_r²,  T = sum |t| rho
///
/// The first two find w by rays of their own (potential.h), defensively, and answer for all elements; adjoint walks
/// answer for what is asked about, all others having infinite standard errors.
/// Test: tests/solvers/target.cpp
class TargetWalk final : public RadiositySolver {
 public:
  enum class Way { optimal_sources, potential_driven, adjoint };
  TargetWalk(Way way, const SolverSettings& settings) : way_(way), settings_(settings) {}
  std::string name() const override;
  SolverReport advance(const System& system, SolverState& state, const StoppingRule& rule, Run& run) const override;

 private:
  SolverReport shoot(const System& system, SolverState& state, const StoppingRule& rule, Run& run) const;
  SolverReport gather(const System& system, SolverState& state, const StoppingRule& rule, Run& run) const;

  Way way_;
  SolverSettings settings_;
};

}  // namespace interflect::solvers
